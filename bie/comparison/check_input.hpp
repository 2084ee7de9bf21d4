#pragma once

#include <filesystem>
#include <vector>

#include "bie/comparison/check_fields.hpp"
#include "bie/comparison/time_span.hpp"
#include "bie/physics/point_sources.hpp"

/// The file through which the boundary-integral side talks to the finite-element side: docs/check.md has its layout.
namespace vehd {

/// Version of the layout, which both sides must agree in.
constexpr std::int64_t check_schema_version = 5;

/// Problem of V_m in time.
struct InTime {
  TimeSpan span;
  Vector at_order;     ///< V_m at its end by potential_in_time() with the steps of the run, [n_coefficients]
  Vector for_error;    ///< at estimate_order() with finer ones
  Vector by_motion{};  ///< change_by_finer_motion()
};

/// All that the file holds.
struct CheckInput {
  const CheckProblem& problem;
  const std::vector<CheckFields>& at_order;   ///< of each vesicle
  const std::vector<CheckFields>& for_error;  ///< at estimate_order()
  const InTime* in_time = nullptr;            ///< of one vesicle alone; null: not asked for
};

/// One vesicle at the top of the file, several in groups of their own.
/// @throws OutputError
void write_check_input(const std::filesystem::path& file, const CheckInput& input);

/// A file with the shapes alone.
/// @throws OutputError
void write_shape_input(const std::filesystem::path& file, const FrozenShape& shape);

/// The shape and the point sources of the exact solution on it.
/// @param position  coefficients, [n_coefficients x 3]
/// @throws OutputError
void write_sources_input(const std::filesystem::path& file, const Matrix& position, const ElectricParameters& electric,
                         const std::vector<PointSource>& sources);

}  // namespace vehd
