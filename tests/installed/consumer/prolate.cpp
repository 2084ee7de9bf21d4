// Area and volume of a 2:1 prolate spheroid against their formulas.
#include <bie/geometry/surface.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>

int main() {
  const vehd::SphereTransform transform(16, vehd::make_grid(16));
  const vehd::SphereGrid& grid = transform.grid();
  vehd::Matrix position(grid.n_points(), 3);
  for (int i = 0; i < grid.n_theta; ++i) {
    for (int j = 0; j < grid.n_phi; ++j) {
      const double theta = grid.theta[i];
      const double phi = grid.phi[j];
      position.row(i * grid.n_phi + j) << std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
          2.0 * std::cos(theta);
    }
  }
  const vehd::Surface surface = vehd::make_surface(transform, transform.analyze(position));
  const double pi = std::numbers::pi;
  const double eccentricity = std::sqrt(3.0) / 2.0;
  const double area = 2.0 * pi * (1.0 + 2.0 / eccentricity * std::asin(eccentricity));
  const double area_error = std::abs(vehd::surface_area(surface) / area - 1.0);
  const double volume_error = std::abs(vehd::enclosed_volume(surface) / (8.0 * pi / 3.0) - 1.0);
  std::printf("relative errors: area %.2e, volume %.2e\n", area_error, volume_error);
  return area_error < 1e-9 && volume_error < 1e-9 ? 0 : 1;
}
