#include "bie/runs/history.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <sstream>
#include <string_view>

#include "bie/runs/run_files.hpp"
#include "bie/runs/summary.hpp"
#include "bie/runs/verdict.hpp"
#include "bie/support/checksum.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/files.hpp"

namespace {

const std::optional<vehd::UnitsScene> kScales = vehd::UnitsScene{1e-5, 2e-4, 1e-3, {}};
/// There is no potential.
const vehd::OutputUnits kUnits(kScales, {{"time", "ms"}, {"length", "um"}, {"potential", "mV"}});

vehd::HistoryRow row_at(double time) {
  vehd::HistoryRow row;
  row.time = time;
  row.order = 12;
  row.diagnostics.vesicles.resize(1);
  vehd::VesicleDiagnostics& d = row.diagnostics.vesicles[0];
  d.extent_x = 2.5;
  d.Vm_max = 0.25;
  d.strain_max = time > 4.0 ? 1.0 : 0.0;
  return row;
}

struct Written {
  TemporaryDirectory directory;
  std::filesystem::path path = directory / "history.csv";
  std::int64_t bytes = 0, checksum = 0;

  explicit Written(const vehd::OutputUnits& units) {
    vehd::HistoryFile file(path, 0, 0, units);
    for (const double time : {0.0, 2.5, 5.0}) file.append(row_at(time));
    bytes = file.bytes();
    checksum = file.checksum();
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(history)

BOOST_AUTO_TEST_CASE(a_membrane_that_porates_and_differs_from_place_to_place_has_the_columns_of_both) {
  vehd::HistoryKind kind(vehd::HistoryKind::of_each);
  const std::size_t usual = vehd::history_columns(kind).size();
  kind.poration = vehd::PorationModel::pores;
  const std::size_t of_pores = vehd::history_columns(kind).size();
  kind.varying = true;
  const auto& both = vehd::history_columns(kind);
  BOOST_TEST(of_pores == usual + 3);
  BOOST_TEST_REQUIRE(both.size() == of_pores + 4);
  const auto place = [&](std::string_view name) { return std::ranges::find(both, name, &vehd::HistoryColumn::name); };
  BOOST_TEST_REQUIRE((place("conductance_max") != both.end()));
  BOOST_TEST((place("net_force_z") - place("conductance_max")) == 6);
  // With several vesicles these are columns of each vesicle.
  kind.rows = vehd::HistoryKind::of_all;
  BOOST_TEST(vehd::history_columns(kind).size() == vehd::history_columns(vehd::HistoryKind::of_all).size());
}

BOOST_AUTO_TEST_CASE(beside_a_wall_gap_and_force_have_columns) {
  for (const auto rows : {vehd::HistoryKind::of_one, vehd::HistoryKind::of_all, vehd::HistoryKind::of_each}) {
    vehd::HistoryKind kind(rows);
    const auto count = [&kind](std::string_view name) {
      return std::ranges::count(vehd::history_columns(kind), name, &vehd::HistoryColumn::name);
    };
    BOOST_TEST(count("gap_wall") == 0);
    kind.wall = true;
    for (const bool varying : {false, true}) {
      kind.varying = varying;
      BOOST_TEST(count("gap_wall") == 1);
      BOOST_TEST(count("force_wall") == 1);
      BOOST_TEST(count("gap_degree") == (rows == vehd::HistoryKind::of_each ? 0 : 1));
    }
  }
}

BOOST_AUTO_TEST_CASE(columns_go_by_their_plain_names_whatever_their_units) {
  const Written si(kUnits), plain({});
  const vehd::HistoryTable shown(si.path), numbers(plain.path);
  const auto tolerance = boost::test_tools::tolerance(1e-14);
  BOOST_TEST(shown.header("time") == "time [ms]");
  BOOST_TEST(shown.unit("extent_x") == "um");
  BOOST_TEST(shown.column("time")[1] == 0.5, tolerance);
  BOOST_TEST(shown.column("extent_x")[0] == 25.0, tolerance);
  BOOST_TEST(numbers.header("time") == "time");
  BOOST_TEST(numbers.unit("extent_x") == "");
  BOOST_TEST(numbers.column("extent_x")[0] == 2.5);
  // Without a scale the unit has no meaning.
  BOOST_TEST(shown.header("Vm_max") == "Vm_max");
  BOOST_TEST(shown.column("Vm_max")[0] == 0.25);
  // Counts are whole numbers.
  BOOST_TEST(file_text(plain.path).find(",12,") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_history_names_its_units) {
  const Written si(kUnits);
  vehd::ReadingNotes notes;
  const vehd::OutputUnits units = vehd::units_of_run({si.path.parent_path()}, kScales, notes);
  BOOST_TEST(units.of("time").symbol == "ms");
  BOOST_TEST(units.of("time").factor == 0.2, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(!units.of("area").is_si());
  std::filesystem::remove(si.path);
  BOOST_TEST(!vehd::units_of_run({si.path.parent_path()}, kScales, notes).of("time").is_si());
  BOOST_TEST(notes.empty());
}

BOOST_AUTO_TEST_CASE(a_history_continues_after_the_rows_that_the_checkpoint_counts) {
  const Written si(kUnits);
  const std::string text = file_text(si.path);
  write_text(si.path, text + "3,4");
  vehd::require_history(si.path, si.bytes, si.checksum);
  vehd::HistoryFile file(si.path, si.bytes, si.checksum, vehd::HistoryTable(si.path).units(kScales));
  BOOST_TEST(file_text(si.path) == text);
  file.append(row_at(7.5));
  BOOST_TEST(vehd::HistoryTable(si.path).column("time").back() == 1.5, boost::test_tools::tolerance(1e-14));
  vehd::require_columns(si.path, vehd::HistoryKind::of_one);
  const auto without = [&](const char* from, const char* to) {
    return std::string(text).erase(text.find(from), text.find(to) - text.find(from));
  };
  for (const std::string& other : {std::string(text).replace(text.find("extent_x"), 8, "extent_w"),
                                   without(",treading_frequency", ",checksum"), without(",checksum", "\n")}) {
    write_text(si.path, other);
    BOOST_CHECK_THROW(vehd::require_columns(si.path, vehd::HistoryKind::of_one), vehd::InputError);
  }
}

// The checksum covers all rows above it, so that removed or exchanged rows are detected as well.
BOOST_AUTO_TEST_CASE(an_altered_row_is_named) {
  const Written written({});
  const std::string text = file_text(written.path);
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line + "\n");
  const auto refusal_of = [&](const std::string& altered) {
    write_text(written.path, altered);
    try {
      (void)vehd::HistoryTable(written.path);
    } catch (const vehd::InputError& error) {
      return std::string(error.what()).substr(written.path.string().size());
    }
    return std::string();
  };
  const std::string why = ": does not match its checksum: it was altered, or lines before it were altered or removed";
  BOOST_TEST(refusal_of(text) == "");
  std::string edited = lines[2];
  edited.front() = '9';
  BOOST_TEST(refusal_of(lines[0] + lines[1] + edited + lines[3]) == ":3" + why);
  BOOST_TEST(refusal_of(lines[0] + lines[2] + lines[3]) == ":2" + why);
  BOOST_TEST(refusal_of(lines[0] + lines[1] + lines[3] + lines[2]) == ":3" + why);
  BOOST_TEST(refusal_of(lines[0] + lines[1] + lines[2] + lines[2]) == ":4" + why);
  std::string header = lines[0];
  header.replace(header.find("extent_x"), 8, "extent_y");
  BOOST_TEST(refusal_of(header + lines[1] + lines[2]) == ":2" + why);
  BOOST_TEST(refusal_of(lines[0] + lines[1] + "3,4\n") == ":3" + why);
  // A row cut off by a kill does not count.
  BOOST_TEST(refusal_of(lines[0] + lines[1] + "3,4") == "");
  BOOST_TEST(vehd::HistoryTable(written.path).n_rows() == 1U);
}

BOOST_AUTO_TEST_CASE(the_verdict_says_times_with_their_unit) {
  BOOST_TEST(vehd::verdict_of(vehd::HistoryTable(Written(kUnits).path), {}, "").find("since time 1 ms") !=
             std::string::npos);
  BOOST_TEST(vehd::verdict_of(vehd::HistoryTable(Written({}).path), {}, "").find("since time 5 (") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_pipe_is_no_history) {
  const TemporaryDirectory directory;
  const std::string file = directory / "history.csv";
  BOOST_TEST_REQUIRE(::mkfifo(file.c_str(), 0600) == 0);
  BOOST_CHECK_EXCEPTION(vehd::HistoryTable{file}, vehd::InputError, [&](const vehd::InputError& error) {
    return error.what() == file + ": no such file or empty";
  });
}

BOOST_AUTO_TEST_CASE(normal_stresses_are_differences_of_the_stress) {
  vehd::HistoryRow row;
  row.diagnostics.vesicles.resize(1);
  row.diagnostics.vesicles[0].rheology.bending.diagonal() << 5.0, 1.0, 2.0;
  row.diagnostics.vesicles[0].rheology.tension.diagonal() << 0.5, 0.25, -1.0;
  const auto& columns = vehd::history_columns();
  const vehd::Vector values = vehd::values_of(row, {});
  const auto value = [&](std::string_view name) {
    return values[std::ranges::find(columns, name, &vehd::HistoryColumn::name) - columns.begin()];
  };
  BOOST_TEST(value("normal_stress_1") == value("stress_xx") - value("stress_zz"));
  BOOST_TEST(value("normal_stress_1") == 4.5);
  BOOST_TEST(value("normal_stress_2") == -0.25);
}

BOOST_AUTO_TEST_CASE(the_regime_is_that_of_the_second_half) {
  // In ms, frequencies in 1/s: the units must not matter.
  const auto regime = [&](auto turns, double treading) {
    vehd::HistoryTable table(kUnits, vehd::HistoryKind::of_one);
    for (int i = 0; i <= 200; ++i) {
      vehd::HistoryRow row = row_at(0.1 * i);
      // In (−90, 90], the range for an axis.
      row.diagnostics.vesicles[0].tumbling_angle_deg = 360.0 * std::remainder(turns(row.time), 0.5);
      row.diagnostics.vesicles[0].treading_frequency = treading;
      table.append(row);
    }
    return vehd::regime_of(table, kUnits);
  };
  const auto settling = [](double t) { return t < 9.0 ? 0.1 * t : 0.9; };
  BOOST_TEST(regime(settling, -0.05) == "tank-treading");
  BOOST_TEST(regime(settling, 0.001) == "unsettled");
  BOOST_TEST(regime([](double t) { return -0.06 * t; }, 0.01) == "tumbling");
  BOOST_TEST(regime([](double t) { return 0.03 * std::cos(2.0 * t); }, 0.05) == "trembling");
  BOOST_TEST(regime([](double t) { return std::exp(-t / 10.0); }, 0.05) == "unsettled");
  BOOST_TEST(regime([](double) { return 0.0; }, 0.0) == "");
}

BOOST_AUTO_TEST_SUITE_END()
