#include "fem_check/app/compared_field.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fem_check/app/surface_series.hpp"

namespace vehd::fem_check {

const char* name_of(Reference reference) {
  if (reference == Reference::elements) return "elements";
  return reference == Reference::constraint ? "constraint" : "boundary integrals";
}

double mean_size(const Eigen::MatrixXd& coefficients, const SurfacePoints& points) {
  if (coefficients.size() == 0) return 0.0;
  const Eigen::MatrixXd values = SurfaceSeries(coefficients)(points);
  return std::sqrt(values.colwise().squaredNorm().dot(points.weight) / points.weight.sum());
}

NaturalSizes natural_sizes(const CheckInput& input, const ComparisonPoints& at) {
  const Physics& physics = input.physics;
  const double radius = at.radius, potential = mean_size(input.potential, at.surface);
  const double inside = physics.conductivity_in, outside = physics.conductivity_out;
  NaturalSizes sizes;
  sizes.potential = physics.field.norm() * radius + potential;
  sizes.field = sizes.potential / radius;
  // Relaxing free charge has no typical size of its own.
  sizes.charge = input.charged_faces() ? sizes.field : sizes.field * std::abs(inside - outside) / (inside + outside);
  sizes.electric_force = physics.permittivity_out * sizes.field * sizes.field;
  sizes.current = inside * outside / (inside + outside) * sizes.field + physics.conductance * potential +
                  mean_size(input.conductance, at.surface) * potential + mean_size(input.pump_current, at.surface);
  const double shear = physics.flow_gradient.norm();
  sizes.force = physics.bending_modulus / (radius * radius * radius) + physics.viscosity_out * shear +
                mean_size(input.force, at.surface);
  sizes.velocity = sizes.force * radius / physics.viscosity_out;
  sizes.rate = sizes.velocity / radius;
  return sizes;
}

int degree_of(const Eigen::MatrixXd& coefficients) {
  return static_cast<int>(std::lround(std::sqrt(static_cast<double>(coefficients.rows())))) - 1;
}

namespace {

/// Decay between the degrees, measured over at least half the lower degree, as coefficients need not decrease at once.
/// @param finer  coefficients at the higher of both degrees
std::optional<double> decay_of(const Eigen::MatrixXd& finer, const Degrees& degrees) {
  const Eigen::Index lower = std::min(degrees.judged, degrees.other), higher = std::max(degrees.judged, degrees.other);
  const Eigen::Index width = higher - lower, distance = std::max(width, lower / 2);
  const auto size = [&](Eigen::Index above, Eigen::Index up_to) {
    const Eigen::Index first = (above + 1) * (above + 1);
    return finer.middleRows(first, (up_to + 1) * (up_to + 1) - first).norm();
  };
  if (width == 0 || distance > lower) return {};
  const double before = size(lower - distance, higher - distance);
  if (!(before > 0.0)) return {};
  return std::pow(size(lower, higher) / before, static_cast<double>(width) / static_cast<double>(distance));
}

}  // namespace

ComparedField field_on_surface(const ComparisonPoints& at, const std::string& name, const std::string& label,
                               const std::string& values, const Eigen::MatrixXd& judged, const Eigen::MatrixXd& bie,
                               const Eigen::MatrixXd& bie_high, double natural_size) {
  const SurfacePoints& points = at.surface;
  ComparedField compared;
  compared.name = name;
  compared.label = label;
  compared.values = values;
  compared.judged = SurfaceSeries(judged)(points);
  compared.bie = SurfaceSeries(bie)(points);
  compared.bie_high = SurfaceSeries(bie_high)(points);
  compared.degrees = {degree_of(bie), degree_of(bie_high), {}};
  compared.degrees.decay = decay_of(bie.rows() > bie_high.rows() ? bie : bie_high, compared.degrees);
  compared.weight = points.weight;
  compared.natural_size = natural_size;
  return compared;
}

ComparedField without_uniform_tension(ComparedField compared, const SurfacePoints& points) {
  for (Eigen::MatrixXd* values : {&compared.judged, &compared.bie, &compared.bie_high}) {
    const bool is_tension = values->rows() == 1;
    const Eigen::MatrixXd direction =
        is_tension ? Eigen::MatrixXd(Eigen::MatrixXd::Ones(1, points.size())) : Eigen::MatrixXd(points.normal);
    const double mean = values->cwiseProduct(direction).colwise().sum().dot(points.weight) / points.weight.sum();
    *values -= mean * direction;
  }
  return compared;
}

ComparedField without(ComparedField compared, const Eigen::MatrixXd& of_points) {
  for (Eigen::MatrixXd* field : {&compared.judged, &compared.bie, &compared.bie_high}) *field -= of_points;
  compared.from_level = [of_points](const Eigen::MatrixXd& values) { return Eigen::MatrixXd(values - of_points); };
  return compared;
}

}  // namespace vehd::fem_check
