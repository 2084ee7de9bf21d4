#pragma once

#include <filesystem>
#include <vector>

#include "bie/comparison/check_fields.hpp"
#include "bie/comparison/check_samples.hpp"
#include "bie/comparison/time_span.hpp"
#include "bie/physics/point_sources.hpp"

/// The file through which the boundary-integral side talks to the finite-element side: docs/check.md has its layout.
namespace vehd {

/// Version of the layout, which both sides must agree in.
constexpr std::int64_t check_schema_version = 4;

/// What is asked about V_m in time.
struct InTime {
  TimeSpan span;
  Vector at_order;     ///< V_m at its end by potential_in_time(), with the steps of the run
  Vector for_error;    ///< at estimate_order() with finer ones
  Vector by_motion{};  ///< change_by_finer_motion()
};

/// All that the file holds of one vesicle.
struct CheckInput {
  const FrozenState& frozen;
  const CheckContents& contents;
  const Matrix& force;  ///< total_force of the stored fields
  const CheckSamples& samples;
  const CheckFields& at_order;
  const CheckFields& for_error;     ///< at estimate_order()
  const InTime* in_time = nullptr;  ///< null: not asked for
  std::size_t vesicle = 0;          ///< its number in the frozen state
};

/// Of one vesicle. @throws OutputError
void write_check_input(const std::filesystem::path& file, const CheckInput& input);
/// Of several, in groups of their own. @throws OutputError
void write_check_inputs(const std::filesystem::path& file, const std::vector<CheckInput>& inputs);

/// The same file with the shapes alone. @throws OutputError
void write_shape_input(const std::filesystem::path& file, const FrozenShape& shape);

/// The shape and the point sources that make the exact solution on it. @throws OutputError
void write_sources_input(const std::filesystem::path& file, const Matrix& position, const ElectricParameters& electric,
                         const std::vector<PointSource>& sources);

}  // namespace vehd
