#include <fmt/format.h>

#include <memory>

#include "bie/app/commands.hpp"
#include "bie/app/scene_choice.hpp"
#include "bie/comparison/check.hpp"
#include "bie/comparison/frozen_state.hpp"

namespace vehd {
namespace {

struct MeshOptions {
  std::filesystem::path file;
  std::optional<std::string> time;
  std::string output;
  std::string family = "hex";
  int refine = 0;
  CommonOptions common;
};

ExitCode mesh(const MeshOptions& options) {
  const FemProgram fem;
  const FrozenShape shape = read_frozen_shape(options.file, options.time);
  for (const std::string& note : shape.notes) fmt::print(stderr, "{}\n", note);
  const FemProgram::Result result = write_volume_mesh(fem, {shape, options.output, options.family, options.refine});
  if (result.code != ExitCode::done) return result.code;
  fmt::print("mesh: {}\n", options.output);
  write_json(options.common, result.json);
  return result.code;
}

}  // namespace

void add_mesh_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("mesh", "Write the gmsh volume mesh of a frozen shape, or of two");
  const auto options = std::make_shared<MeshOptions>();
  add_frozen_state(*command, options->file);
  add_snapshot_time(*command, options->time);
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
