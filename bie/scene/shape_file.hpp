#pragma once

#include <optional>

#include "bie/files/run_reader.hpp"
#include "bie/scene/scene.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// The snapshot of a run.h5 with which a scene of [shape] kind "file" starts. All numbers are those of the scene:
/// lengths, times and potentials are converted where both have the reference scale, and taken as they are where neither
/// has; check_shape_file refuses a scene for which that is not enough.
class ShapeFile {
 public:
  /// @throws InputError if the file is damaged, no run.h5, or has no snapshot at that time
  explicit ShapeFile(const Scene& scene);

  /// Coefficients in the order of that run, [n_coefficients x 3]. @throws InputError
  [[nodiscard]] Matrix position() const;
  /// Whether the snapshot has V_m.
  [[nodiscard]] bool has_potential() const { return snapshot().has_field("Vm"); }
  /// V_m of a file that has it, likewise. @throws InputError
  [[nodiscard]] Vector potential() const;

 private:
  [[nodiscard]] RunSnapshot snapshot() const { return run_.snapshot(number_); }

  RunReader run_;
  std::size_t number_ = 0;
  double length_ = 1.0, potential_ = 1.0;  ///< of 1 in the file, in the scene
};

/// Reference scales of a run; nullopt if its scene has no [units]. @throws InputError
std::optional<UnitsScene> units_of(const RunReader& run);

/// Whether V_m at time 0 is that of the shape file.
bool takes_stored_potential(const Scene& scene);

}  // namespace vehd
