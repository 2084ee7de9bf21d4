#pragma once

#include <boost/test/unit_test.hpp>
#include <functional>
#include <nlohmann/json.hpp>

#include "tests/app/check_numbers.hpp"
#include "tests/app/finite_elements.hpp"
#include "tests/app/reference_run.hpp"

// Tests that the check agrees with a run whose membrane does not move, and disagrees with every damaged copy of it.

using vehd::CheckFields;
using vehd::FrozenState;

struct Damage {
  std::string name;
  std::function<void(CheckNumbers&)> apply;
  std::string group, row;  ///< a row that must detect the damage
};

template <typename Values>
Damage field_by(const std::string& name, Values CheckFields::*field, const std::string& group, const std::string& row) {
  constexpr double factor = 1.002;
  return {name,
          [=](CheckNumbers& numbers) {
            for (CheckFields* fields : {&numbers.bie.front(), &numbers.high.front()}) fields->*field *= factor;
          },
          group, row};
}

/// One side of the comparison has another coefficient, or interior and exterior are exchanged.
inline Damage state_with(const std::string& name, const std::function<void(FrozenState&)>& change,
                         const std::string& group, const std::string& row) {
  return {name,
          [=](CheckNumbers& numbers) {
            FrozenState wrong = numbers.problem.frozen;
            change(wrong);
            numbers.solve(wrong);
          },
          group, row};
}

/// Requires that the given rows agree, and that each damage makes its row disagree.
inline void check_and_damage(const FinishedRun& run, const std::string& time, const std::vector<const char*>& fields,
                             const std::vector<const char*>& stored, const std::vector<Damage>& damages) {
  const std::string file = run.output + "/run.h5";
  const CheckNumbers right(vehd::check_problem(vehd::read_frozen_state({file, {}}, time)), 10, 15);
  const auto written = [&](const std::string& name, const CheckNumbers& n) {
    n.write(run.directory / name);
    return run.directory / name;
  };
  std::vector<std::string> command{
      finite_element_program().string(), "check",  written("right.h5", right),   "--quick", "-o",
      run.directory / "elements",        "--json", run.directory / "result.json"};
  for (std::size_t i = 0; i < damages.size(); ++i) {
    CheckNumbers wrong = right;
    damages[i].apply(wrong);
    command.insert(command.end(), {"--further", written("wrong" + std::to_string(i) + ".h5", wrong)});
  }
  const ProgramResult program = run_command(command);
  BOOST_TEST(program.exit_code == 0, program.output + program.errors);
  const nlohmann::json json = json_of(run.directory / "result.json");
  for (const char* row : fields) {
    BOOST_TEST(json["fields"][row]["verdict"] == "agree", row);
  }
  for (const char* row : stored) {
    BOOST_TEST(json["stored"][row]["verdict"] == "agree", row);
  }
  BOOST_TEST_REQUIRE(json["further"].size() == damages.size());
  for (std::size_t i = 0; i < damages.size(); ++i) {
    const Damage& damage = damages[i];
    BOOST_TEST(json["further"][i][damage.group][damage.row]["verdict"] == "disagree",
               damage.name << " in " << damage.row << ": " << json["further"][i][damage.group][damage.row]);
  }
}
