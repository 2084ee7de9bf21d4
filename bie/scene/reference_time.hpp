#pragma once

#include <optional>

#include "bie/scene/scene.hpp"
#include "bie/scene/si_values.hpp"

namespace vehd {

/// The shortest of the times that a scene gives in SI units, s: what is fastest in it. A pulse, the period of a
/// waveform, the time of a rate of flow, and, with the reference length L and viscosity μ, the charging time
/// L C_m (1/σ_i + 1/(2σ_e)), the electric time μ/(ε E²) and the bending time μ L³/κ_B.
/// @return nullopt if it gives none
std::optional<double> shortest_time(const SiValues& si, const UnitsScene& units);

}  // namespace vehd
