#include "bie/scene/shape_file.hpp"

#include "bie/scene/run_reader.hpp"

namespace vehd {

Matrix read_shape_file(const std::string& path, std::optional<double> time) {
  const RunReader run(path);
  return run.coefficients(time ? run.at(*time) : run.times().size() - 1, "x", 3);
}

}  // namespace vehd
