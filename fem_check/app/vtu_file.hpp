#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace vehd::fem_check {

/// Field on the points of a file, [components x points] with 1 or 3 components.
struct NamedField {
  std::string name;
  Eigen::MatrixXd values;
};

/// Shape of the cells of a file.
enum class VtuCells { quadrilaterals, hexahedra };

/// Lattices of (intervals + 1)^d points each, one after another, first coordinate fastest.
struct Lattices {
  VtuCells cells;
  int intervals;
  Eigen::Matrix3Xd points;
};

/// Writes an unstructured grid for ParaView with numbers as raw appended data. deal.II's own writer uses single
/// precision, which cannot distinguish two methods that agree to seven digits.
/// @throws InputError if it cannot be written
void write_vtu(const std::filesystem::path& file, const Lattices& lattices, const std::vector<NamedField>& fields);

}  // namespace vehd::fem_check
