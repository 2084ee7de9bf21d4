#include "fem_check/app/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <fstream>

#include "fem_check/app/check.hpp"
#include "fem_check/app/check_input.hpp"
#include "fem_check/app/hdf5_input.hpp"
#include "fem_check/app/mesh.hpp"
#include "fem_check/app/point_sources.hpp"
#include "fem_check/app/shape_flow.hpp"
#include "fem_check/session.hpp"
#include "meshes/types.hpp"

namespace vehd::fem_check {
namespace {

/// Requirement for coarse elements: it verifies signs, sides and conditions, and the first digit of small remainders.
constexpr double required_when_quick = 0.05;

/// Exit codes of vehd: done, whatever the verdict, since mpirun reports any other code as a failure; wrong input;
/// internal error.
enum ExitCode { done = 0, refused = 1, internal_error = 2 };

void write_json(const std::string& path, const nlohmann::json& json) {
  if (path.empty()) return;
  std::ofstream file(path, std::ios::trunc);
  // Bytes that are not UTF-8, as in some file names, become U+FFFD.
  file << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
  file.close();
  if (!file) throw InputError(path + ": cannot be written");
}

/// Prints the names of the rows that do not agree.
void print_reasons(const CheckResult& result) {
  const std::vector<std::string> wrong = result.rows_with(Verdict::disagree),
                                 open = result.rows_with(Verdict::undecided);
  if (!wrong.empty()) {
    fmt::print(stderr, "{}: the two methods disagree in: {}\n", result.source, fmt::join(wrong, ", "));
  }
  if (!open.empty()) {
    fmt::print(stderr, "{}: undecided, errors above {:.3g} of the field: {}\n", result.source, result.required,
               fmt::join(open, ", "));
  }
}

int check(CheckTask task, const std::string& json_file, const Session& session) {
  task.judges = session.rank() == 0;
  task.writes = session.rank() == session.n_ranks() - 1;
  const std::vector<CheckResult> results = run_check(task, [&](const std::string& line) {
    if (task.judges) fmt::print(stderr, "{}\n", line);
  });
  if (!task.judges) return done;
  const CheckResult& result = results.front();
  fmt::print("{}files: {}\n", table_of(result), task.directory.string());
  std::fflush(stdout);
  nlohmann::json json = json_of(result);
  for (std::size_t i = 1; i < results.size(); ++i) json["further"].push_back(json_of(results[i]));
  write_json(json_file, json);
  print_reasons(result);
  return done;
}

int mesh(const MeshTask& task, const std::string& json_file) {
  const MeshResult result = run_mesh(task);
  fmt::print("{}", text_of(result));
  write_json(json_file, json_of(result));
  return done;
}

int fail(int code, const std::string& message) {
  fmt::print(stderr, "{}\n", message);
  return code;
}

}  // namespace

int run_program(int argc, char** argv) {
  CLI::App program("Finite-element side of vehd: started by vehd check, mesh and bench methods.", "vehd_fem");
  program.require_subcommand(1);
  std::string json_file;

  CheckTask check_task;
  CLI::App* check_command = program.add_subcommand("check", "Solve and compare");
  check_command->add_option("INPUT", check_task.input, "check_input.h5")->required();
  check_command->add_option("-o,--output", check_task.directory, "Directory for the results")->required();
  const CLI::Option* required =
      check_command->add_option("--require", check_task.required, "Largest error of a field over the field")
          ->check(CLI::Range(1e-9, 1.0));
  check_command->add_option(
      "--further", check_task.further_inputs,
      "Further inputs of the same state, compared with the same solutions; results go to the JSON");
  check_command->add_flag("--quick", check_task.quick, "Coarse elements");
  check_command->add_option("--json", json_file, "Also write the result as JSON");

  MeshTask mesh_task;
  CLI::App* mesh_command = program.add_subcommand("mesh", "Mesh a shape");
  mesh_command->add_option("INPUT", mesh_task.input, "File with the shape")->required();
  mesh_command->add_option("-o,--output", mesh_task.output, "Mesh to write")->required();
  mesh_command->add_option("--family", mesh_task.family, "hex or tet")->check(CLI::IsMember({"hex", "tet"}));
  mesh_command->add_option("--refine", mesh_task.refine, "How often the element size is divided by 1.5");
  mesh_command->add_option("--json", json_file, "Also write the result as JSON");

  LevelTask level_task;
  const auto add_level = [&](const char* name, const char* what) {
    CLI::App* command = program.add_subcommand(name, what);
    command->add_option("INPUT", level_task.input, "File with the shape and the problem")->required();
    command->add_option("--degree", level_task.degree, "Of the elements");
    command->add_option("--cells", level_task.cells_per_edge, "Cells per edge of a block");
    command->add_option("--radius", level_task.outer_radius, "Of the outer sphere, over that of the shape");
    command->add_option("--json", json_file, "Where the result goes")->required();
    return command;
  };
  const CLI::App* sources_command = add_level("sources", "Solve for point sources, whose solution is known");
  const CLI::App* shape_command = add_level("shape-flow", "Find the flow from a shape, V_m and the physics alone");

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? done : refused;
  }
  // Not needed for a help page: if killed, MPI leaves temporary files behind.
  const Session session;
  try {
    if (mesh_command->parsed()) return mesh(mesh_task, json_file);
    if (sources_command->parsed()) {
      write_json(json_file, json_of(run_point_sources(level_task)));
      return done;
    }
    if (shape_command->parsed()) {
      write_json(json_file, json_of(run_shape_flow(level_task)));
      return done;
    }
    if (check_task.quick && required->empty()) check_task.required = required_when_quick;
    return check(check_task, json_file, session);
  } catch (const InputError& error) {
    return fail(refused, error.what());
  } catch (const meshes::MeshError& error) {
    const std::filesystem::path& input = mesh_command->parsed()    ? mesh_task.input
                                         : check_command->parsed() ? check_task.input
                                                                   : level_task.input;
    return fail(refused, fmt::format("{}: mesh: {}", source_of(input), error.what()));
  } catch (const std::exception& error) {
    return fail(internal_error, fmt::format("internal error: {}", error.what()));
  }
}

}  // namespace vehd::fem_check
