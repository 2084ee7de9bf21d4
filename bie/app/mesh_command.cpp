#include <fmt/format.h>

#include <memory>

#include "bie/app/check_input.hpp"
#include "bie/app/commands.hpp"
#include "bie/app/fem_program.hpp"
#include "bie/app/file_system.hpp"
#include "bie/app/gnuplot.hpp"

namespace vehd {
namespace {

struct MeshOptions {
  std::string file;
  std::optional<double> time;
  std::string output;
  std::string family = "hex";
  int refine = 0;
  CommonOptions common;
};

ExitCode mesh(const MeshOptions& options) {
  const FemProgram fem;
  const FrozenShape shape = read_frozen_shape(options.file, options.time);
  if (!shape.note.empty()) fmt::print(stderr, "{}\n", shape.note);
  // Hidden beside the mesh: a folder that can hold the one can hold the other.
  const TemporaryFile input(temporary_of(options.output + ".shape.h5"));
  write_shape_input(input.path(), shape.position);
  std::vector<std::string> arguments{"mesh",     input.path().string(), "-o",       options.output,
                                     "--family", options.family,        "--refine", std::to_string(options.refine)};
  if (!options.common.json_file.empty()) arguments.insert(arguments.end(), {"--json", options.common.json_file});
  return fem.run(arguments);
}

}  // namespace

void add_mesh_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("mesh", "Write the gmsh volume mesh of a frozen shape");
  const auto options = std::make_shared<MeshOptions>();
  command->add_option("FILE", options->file, "run.h5 of a run, or a scene (.toml) for its initial shape")->required();
  command->add_option("--time", options->time, "Time; the nearest snapshot is taken, the last one if left out");
  command->add_option("-o,--output", options->output, "Mesh to write (MSH 4.1)")->required()->type_name("FILE.msh");
  command->add_option("--family", options->family, "hex: curved blocks; tet: unstructured tetrahedra")
      ->check(CLI::IsMember({"hex", "tet"}))
      ->capture_default_str();
  command->add_option("--refine", options->refine, "How often the element size is divided by 1.5")
      ->check(CLI::Range(0, 6))
      ->capture_default_str();
  add_common_options(*command, options->common);
  command->footer("Open the mesh with: gmsh FILE.msh. Quality: smallest scaled Jacobian, 1 is a brick, 0 is flat.");
  command->callback([options, &exit_code] { exit_code = mesh(*options); });
}

}  // namespace vehd
