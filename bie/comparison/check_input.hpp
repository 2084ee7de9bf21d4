#pragma once

#include <filesystem>
#include <vector>

#include "bie/comparison/check_fields.hpp"
#include "bie/comparison/time_span.hpp"
#include "bie/physics/point_sources.hpp"

/// The file from the boundary-integral side to the finite-element side; docs/check.md describes its layout.
namespace vehd {

/// Version of the layout, which must be equal on both sides.
constexpr std::int64_t check_schema_version = 6;

/// Solutions of the problem of V_m in time.
struct InTime {
  TimeSpan span;
  Vector at_order;   ///< V_m at the end of the span by potential_in_time() with the steps of the run, [n_coefficients]
  Vector for_error;  ///< V_m at estimate_order() with finer steps
  Vector by_motion{};  ///< change_by_finer_motion()
};

/// The content of the file.
struct CheckInput {
  const CheckProblem& problem;
  const std::vector<CheckFields>& at_order;   ///< each vesicle at the degree of the state
  const std::vector<CheckFields>& for_error;  ///< each vesicle at estimate_order()
  const InTime* in_time = nullptr;            ///< with one vesicle only; null: not requested
};

/// Writes one vesicle at the top of the file, several in groups of their own.
/// @throws OutputError
void write_check_input(const std::filesystem::path& file, const CheckInput& input);

/// Writes a file with the shapes only.
/// @throws OutputError
void write_shape_input(const std::filesystem::path& file, const FrozenShape& shape);

/// Writes the shape and the point sources of the exact solution on it.
/// @param position  coefficients, [n_coefficients x 3]
/// @throws OutputError
void write_sources_input(const std::filesystem::path& file, const Matrix& position, const ElectricParameters& electric,
                         const std::vector<PointSource>& sources);

}  // namespace vehd
