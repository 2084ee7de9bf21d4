#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>

#include "fem_check/app/check.hpp"
#include "fem_check/app/hdf5_input.hpp"
#include "fem_check/app/mesh.hpp"
#include "fem_check/app/point_sources.hpp"
#include "fem_check/session.hpp"
#include "meshes/types.hpp"

/// The finite-element side of `vehd check`, `vehd mesh` and `vehd bench methods`, which start it.
namespace {

using namespace vehd::fem_check;

/// Exit codes of vehd: done; wrong input; internal error; methods that do not agree.
enum ExitCode { done = 0, refused = 1, internal_error = 2, does_not_hold = 4 };

void write_json(const std::string& path, const nlohmann::json& json) {
  if (path.empty()) return;
  std::ofstream file(path, std::ios::trunc);
  file << json.dump(2) << "\n";
  file.close();
  if (!file) throw InputError(path + ": cannot be written");
}

int check(CheckTask task, const std::string& json_file, bool first_rank) {
  task.writes = first_rank;
  const CheckResult result = run_check(task, [&](const std::string& line) {
    if (first_rank) fmt::print(stderr, "{}\n", line);
  });
  if (first_rank) {
    fmt::print("{}files: {}\n", table_of(result), task.directory.string());
    std::fflush(stdout);
    write_json(json_file, json_of(result));
    if (!result.agrees()) {
      fmt::print(stderr, "{}: the two methods do not agree in: {}\n", result.source, result.disagreeing());
    }
  }
  return result.agrees() ? done : does_not_hold;
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

int main(int argc, char** argv) {
  CLI::App program("Finite-element side of vehd: started by vehd check, mesh and bench methods.", "vehd_fem");
  program.require_subcommand(1);
  std::string json_file;

  CheckTask check_task;
  bool quick = false;
  CLI::App* check_command = program.add_subcommand("check", "Solve and compare");
  check_command->add_option("INPUT", check_task.input, "check_input.h5")->required();
  check_command->add_option("-o,--output", check_task.directory, "Directory for the results")->required();
  check_command->add_flag("--quick", quick, "Coarse elements");
  check_command->add_option("--json", json_file, "Also write the result as JSON");

  MeshTask mesh_task;
  CLI::App* mesh_command = program.add_subcommand("mesh", "Mesh a shape");
  mesh_command->add_option("INPUT", mesh_task.input, "File with the shape")->required();
  mesh_command->add_option("-o,--output", mesh_task.output, "Mesh to write")->required();
  mesh_command->add_option("--family", mesh_task.family, "hex or tet")->check(CLI::IsMember({"hex", "tet"}));
  mesh_command->add_option("--refine", mesh_task.refine, "How often the element size is divided by 1.5");
  mesh_command->add_option("--json", json_file, "Also write the result as JSON");

  PointSourceTask sources_task;
  CLI::App* sources_command = program.add_subcommand("sources", "Solve for point sources, whose solution is known");
  sources_command->add_option("INPUT", sources_task.input, "File with the shape and the sources")->required();
  sources_command->add_option("--degree", sources_task.degree, "Of the elements");
  sources_command->add_option("--cells", sources_task.cells_per_edge, "Cells per edge of a block");
  sources_command->add_option("--radius", sources_task.outer_radius, "Of the outer sphere, over that of the shape");
  sources_command->add_option("--json", json_file, "Where the result goes")->required();

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? done : refused;
  }
  // Not for a page of help: MPI leaves files of its own where it is killed.
  const Session session(argc, argv);
  try {
    if (mesh_command->parsed()) return mesh(mesh_task, json_file);
    if (sources_command->parsed()) {
      write_json(json_file, json_of(run_point_sources(sources_task)));
      return done;
    }
    check_task.refinement = quick ? Refinement::quick() : Refinement::finest();
    return check(check_task, json_file, session.rank() == 0);
  } catch (const InputError& error) {
    return fail(refused, error.what());
  } catch (const vehd::meshes::MeshError& error) {
    return fail(refused, fmt::format("mesh: {}", error.what()));
  } catch (const std::exception& error) {
    return fail(internal_error, fmt::format("internal error: {}", error.what()));
  }
}
