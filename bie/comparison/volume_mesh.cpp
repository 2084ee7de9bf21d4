#include "bie/comparison/volume_mesh.hpp"

#include "bie/comparison/check_input.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/temporary.hpp"

namespace vehd {

FemProgram::Result write_volume_mesh(const FemProgram& fem, const MeshTask& task) {
  const TemporaryFolder folder("vehd-mesh");
  const std::filesystem::path input = folder.path() / "shape.h5", mesh = folder.path() / "mesh.msh";
  write_shape_input(input, task.shape);
  FemProgram::Result result = fem.run(
      {"mesh", input.string(), "-o", mesh.string(), "--family", task.family, "--refine", std::to_string(task.refine)});
  if (result.code == ExitCode::done) replace_file(task.output, text_of_file(mesh));
  return result;
}

}  // namespace vehd
