#pragma once

namespace vehd {

/// Velocities of the 2:1 prolate, semi-axes 1, 1, 2, at μ = 1 under the density (x·n) e, along its axis and across it.
/// That density has the total force 3 V e = 8π e and makes the Stokes single layer constant on the surface, so that it
/// is the density of the rigid particle; its speed follows from the resistance 6πμ·2·factor (Oberbeck; Kim & Karrila,
/// Microhydrodynamics, Table 3.4).
/// Accuracy: closed form to rounding; the assembled layer meets it to 1e-11 at p = 16 and to 5e-12 at p = 32
/// (tests/potentials/translating_prolate_test.cpp)
struct ProlateSpeeds {
  double along, across;
};
/// See ProlateSpeeds.
/// Source: Kim and Karrila 1991, Table 3.4
ProlateSpeeds translating_prolate_speeds();

}  // namespace vehd
