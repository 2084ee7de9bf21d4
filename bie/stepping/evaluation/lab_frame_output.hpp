#pragma once

#include <optional>

#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/state/frame.hpp"

namespace vehd {

/// Results of a run in the frame of the laboratory, whatever the frame of the computation.
/// Accuracy: rounding of the rotation (tests/stepping/state/frame_test.cpp)
class LabFrameOutput {
 public:
  /// @param settings  with the degree of the results
  LabFrameOutput(const Frame& frame, const NumericalSettings& settings);

  /// Whether the axes of frame and laboratory differ, so that diagnostics need state and fields.
  [[nodiscard]] bool is_rotated() const { return fine_.has_value(); }
  /// A state in the axes of the laboratory.
  [[nodiscard]] State state(const State& of_frame) const { return in_laboratory(frame_, of_frame); }
  /// Fields in the axes of the laboratory.
  [[nodiscard]] Fields fields(const Fields& of_frame) const { return in_laboratory(frame_, of_frame); }
  /// @param d       of the state in the frame
  /// @param state   in the frame, as are the fields
  [[nodiscard]] Diagnostics diagnostics(const Diagnostics& d, const State& state, const Fields& fields) const;
  /// Diagnostics in the laboratory if no axes are rotated; the origin can differ.
  [[nodiscard]] Diagnostics diagnostics(Diagnostics d) const;

 private:
  Frame frame_;
  std::optional<SphereTransform> fine_;  ///< all longitudes of the upsampled grid; empty without rotation
};

}  // namespace vehd
