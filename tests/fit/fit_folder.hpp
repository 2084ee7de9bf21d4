#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "bie/fit/fit.hpp"
#include "bie/fit/fit_output.hpp"
#include "bie/fit/noise.hpp"
#include "tests/support/files.hpp"

namespace vehd::testing {

/// A sphere of 10 um whose membrane charges in a dc field, in closed form: V_m at the pole is
/// 1.5 E a κ/(κ + a G_m) (1 − exp(−t (κ/a + G_m)/C_m)) with κ = 2 σ_i σ_e/(σ_i + 2 σ_e).
struct ChargingSphere {
  double capacitance = 0.01, conductance = 20.0;  ///< F/m², S/m²
  static constexpr double field = 5e4, radius = 1e-5, conductivity_in = 6e-4, conductivity_out = 4.5e-4;

  [[nodiscard]] static double pair() {
    return 2.0 * conductivity_in * conductivity_out / (conductivity_in + 2.0 * conductivity_out);
  }
  [[nodiscard]] double potential(double time) const {
    const double leak = pair() / radius + conductance;
    return 1.5 * field * radius * pair() / radius / leak * (1.0 - std::exp(-time * leak / capacitance));
  }
  /// Scene in SI units with the potential and the conductivities, which are all that the closed form needs.
  [[nodiscard]] static std::string scene() {
    return "[units]\nlength = \"10 um\"\ntime = \"1 ms\"\npotential = \"1 V\"\n"
           "[shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 1]\n"
           "[membrane]\ncapacitance = \"0.6 uF/cm^2\"\nconductance = \"8 S/m^2\"\n"
           "[fluid]\nviscosity = \"1 mPa s\"\n"
           "[electric]\nfield = [0, 0, \"0.5 kV/cm\"]\nconductivity_in = \"6 uS/cm\"\n"
           "conductivity_out = \"4.5 uS/cm\"\npermittivity = \"80 eps0\"\n"
           "[numerics]\ndegree = 4\ntolerance = 1e-3\nend_time = \"1 ms\"\n";
  }
};

/// A folder with a scene, data and a fit of them.
struct FitFolder {
  TemporaryDirectory directory;

  /// Writes data against time with noise of this deviation; both in units of the header.
  void write_data(const std::string& name, const std::string& header, const std::vector<double>& abscissae,
                  const std::function<double(double)>& exact, double deviation, std::uint64_t seed) const {
    NormalNumbers normal(seed);
    std::string text = header + "\n";
    for (const double at : abscissae) {
      text += fmt::format("{},{:.9g},{}\n", at, exact(at) + deviation * normal(), deviation);
    }
    write_text(directory / name, text);
  }

  [[nodiscard]] FitResult result(const FitFile& fit, const std::string& output = "out", int n_workers = 2) const {
    Interruption interruption;
    const ModelRuns runs(fit.experiments, {.directory = directory / output, .n_workers = n_workers}, interruption);
    return fit_keys(fit, runs);
  }
};

}  // namespace vehd::testing
