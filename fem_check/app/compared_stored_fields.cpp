#include <utility>

#include "fem_check/app/compared_fields.hpp"
#include "fem_check/app/smooth_work.hpp"
#include "fem_check/app/surface_divergence.hpp"
#include "fem_check/app/surface_series.hpp"

namespace vehd::fem_check {
namespace {

ComparedField stored(ComparedField compared) {
  compared.group = RowGroup::stored;
  return compared;
}

/// G_m V_m + J_p.
Eigen::MatrixXd current_through(const CheckInput& input, const SurfacePoints& points) {
  const Eigen::MatrixXd potential = SurfaceSeries(input.potential)(points);
  Eigen::MatrixXd current = input.conductance.size() > 0
                                ? Eigen::MatrixXd(SurfaceSeries(input.conductance)(points).cwiseProduct(potential))
                                : Eigen::MatrixXd(input.physics.conductance * potential);
  if (input.pump_current.size() > 0) current += SurfaceSeries(input.pump_current)(points);
  return current;
}

/// Current that charges the membrane: −(σ_i ∂φ_i/∂n + G_m V_m + J_p) from ∂φ_i/∂n of a level, against C_m dV_m/dt of
/// the run or, with displacement currents, dq_i/dt. It is not stored in snapshots.
ComparedField charging_current(const CheckInput& input, const ComparisonPoints& at, const NaturalSizes& sizes) {
  const Physics& physics = input.physics;
  const Eigen::MatrixXd rate = physics.capacitance * input.bie.potential_rate;
  ComparedField compared =
      field_on_surface(at, "charging_current", input.charged_faces() ? "dq_i/dt" : "C dV_m/dt", "flux_in", rate, rate,
                       physics.capacitance * input.bie_high.potential_rate, sizes.current);
  compared.is_remainder = true;
  // The run uses G_m of the state of the pores, the elements the truncated G_m of the file.
  if (input.bie.rate_truncation.size() > 0) {
    compared.further_error = physics.capacitance * SurfaceSeries(input.bie.rate_truncation)(at.surface);
  }
  const Eigen::MatrixXd leak = current_through(input, at.surface);
  compared.from_level = [leak, sigma = physics.conductivity_in](const Eigen::MatrixXd& flux_in) {
    return Eigen::MatrixXd(-sigma * flux_in - leak);
  };
  return compared;
}

/// σ_i E_i − σ_e E_e, the rate of change of the free charge of both faces; it is not stored in snapshots.
ComparedField free_current(const CheckInput& input, const ComparisonPoints& at, const NaturalSizes& sizes) {
  const double capacitance = input.physics.capacitance;
  const Eigen::MatrixXd rate = capacitance * input.bie.free_charge_rate;
  ComparedField compared = field_on_surface(at, "free_current", "dQ_f/dt", "free_current", rate, rate,
                                            capacitance * input.bie_high.free_charge_rate, sizes.current);
  compared.is_remainder = true;
  return compared;
}

/// ∇_γ·v of the stored velocity minus the value that the constraint prescribes; the residuals of the boundary integrals
/// at both orders are the error.
ComparedField constraint_residual(const CheckInput& input, const ComparisonPoints& at, double rate) {
  const SurfacePoints& points = at.surface;
  const auto left = [&](const Eigen::MatrixXd& velocity, double dilation) {
    const Vector divergence = surface_divergence(input.position, velocity, points.direction);
    return Eigen::MatrixXd((divergence.array() - dilation).matrix().transpose());
  };
  const Eigen::MatrixXd at_order = left(input.bie.velocity_of_shape, input.bie.dilation),
                        for_error = left(input.bie_high.velocity_of_shape, input.bie_high.dilation);
  ComparedField compared;
  compared.name = "surface_divergence";
  compared.label = "div_S v";
  compared.reference = Reference::constraint;
  compared.group = RowGroup::stored;
  compared.is_remainder = true;
  compared.natural_size = rate;
  compared.weight = points.weight;
  compared.judged = left(input.stored.velocity, input.bie.dilation);
  compared.bie = Eigen::MatrixXd::Zero(1, points.size());
  compared.bie_high = compared.bie;
  compared.further_error = (at_order - for_error).cwiseAbs() + for_error.cwiseAbs();
  return compared;
}

}  // namespace

std::vector<ComparedField> stored_electric_fields(const CheckInput& input, const ComparisonPoints& at) {
  const NaturalSizes sizes = natural_sizes(input, at);
  std::vector<ComparedField> list{
      stored(field_on_surface(at, "q", "q", "q", input.stored.charge, input.bie.charge, input.bie_high.charge,
                              sizes.charge)),
      stored(field_on_surface(at, "force", "f_E", "force", input.stored.force_electric, input.bie.force_electric,
                              input.bie_high.force_electric, sizes.electric_force))};
  if (!input.charged_faces()) return list;
  list.push_back(
      stored(field_on_surface(at, "Vm_of_charges", "V_m", "Vm_of_charges", input.potential,
                              input.bie.potential_of_charges, input.bie_high.potential_of_charges, sizes.potential)));
  return list;
}

std::vector<ComparedField> charging_currents(const CheckInput& input, const ComparisonPoints& at) {
  const NaturalSizes sizes = natural_sizes(input, at);
  std::vector<ComparedField> list{charging_current(input, at, sizes)};
  if (input.charged_faces()) list.push_back(free_current(input, at, sizes));
  return list;
}

ComparedField potential_in_time(const CheckInput& input, const ComparisonPoints& at, const ChargingLevels& charging) {
  const InTime& in_time = *input.in_time;
  ComparedField compared = field_on_surface(at, "Vm", "V_m", "Vm", input.potential, in_time.bie, in_time.bie_high,
                                            natural_sizes(input, at).potential);
  compared.group = RowGroup::in_time;
  compared.time_error = charging.time_error;
  // The change is due to degrees and steps together.
  compared.degrees = {};
  // For steps of first order the error is 4/3 of the change by quartering them: twice the change is counted.
  compared.further_error = (compared.bie - compared.bie_high).cwiseAbs();
  if (in_time.by_motion.size() > 0) {
    compared.further_error += 2.0 * SurfaceSeries(in_time.by_motion)(at.surface).cwiseAbs();
  }
  return compared;
}

namespace {

/// Stored fields determined by the shape, with the boundary integrals as reference, and with the elements if these
/// provide the field.
class StoredOfShape {
 public:
  StoredOfShape(const CheckInput& input, const ComparisonPoints& at, const Level* of_shape)
      : input_(input), at_(at), sizes_(natural_sizes(input, at)), of_shape_(of_shape) {}

  void add_bending() {
    if (input_.stored.force_bending.size() == 0) return;
    ComparedField field =
        against_integrals("force_bending", "f_b", input_.stored.force_bending, &BieFields::force_bending);
    ComparedField work = field;
    field.has_work_row = elements_have("bending");
    list.push_back(std::move(field));
    if (!elements_have("bending")) return;
    work.name = "force_bending_work";
    work.label = "f_b, work";
    compare_with_elements(work, "bending");
    list.push_back(work_on_smooth(std::move(work), at_.surface));
  }

  void add_tension() {
    if (input_.stored.tension.size() == 0) return;
    ComparedField field =
        against_integrals("force_tension", "f_lambda", input_.stored.force_tension, &BieFields::force_tension);
    ComparedField tension = against_integrals("tension", "lambda", input_.stored.tension, &BieFields::tension);
    tension.natural_size *= at_.radius;
    ComparedField work = field;
    field.has_work_row = elements_have("tension");
    list.push_back(std::move(field));
    if (elements_have("tension")) {
      work.name = "force_tension_work";
      work.label = "f_lambda, work";
      for (ComparedField* each : {&work, &tension}) compare_with_elements(*each, "tension");
      list.push_back(work_of_tension(std::move(work), input_.position, at_.surface));
    }
    list.push_back(std::move(tension));
  }

  std::vector<ComparedField> list;

 private:
  [[nodiscard]] bool elements_have(const std::string& values) const {
    return of_shape_ != nullptr && of_shape_->surface.contains(values);
  }
  /// Field with the boundary integrals as the only reference.
  [[nodiscard]] ComparedField against_integrals(const std::string& name, const std::string& label,
                                                const Eigen::MatrixXd& judged,
                                                Eigen::MatrixXd BieFields::*field) const {
    ComparedField result =
        stored(field_on_surface(at_, name, label, "", judged, input_.bie.*field, input_.bie_high.*field, sizes_.force));
    result.reference = Reference::boundary_integrals;
    if (name != "force_bending" && input_.bie.tension_is_free) {
      result = without_uniform_tension(std::move(result), at_.surface);
    }
    return result;
  }
  static void compare_with_elements(ComparedField& compared, const std::string& values) {
    compared.reference = Reference::elements;
    compared.values = values;
  }

  const CheckInput& input_;
  const ComparisonPoints& at_;
  NaturalSizes sizes_;
  const Level* of_shape_;
};

}  // namespace

std::vector<ComparedField> stored_fields_of_shape(const CheckInput& input, const ComparisonPoints& at,
                                                  const Level* of_shape) {
  StoredOfShape fields(input, at, of_shape);
  fields.add_bending();
  fields.add_tension();
  return std::move(fields.list);
}

std::vector<ComparedField> stored_flow_fields(const CheckInput& input, const ComparisonPoints& at) {
  const NaturalSizes sizes = natural_sizes(input, at);
  const SurfacePoints& points = at.surface;
  std::vector<ComparedField> list;
  ComparedField velocity =
      without(stored(field_on_surface(at, "velocity", "v", "velocity", input.stored.velocity, input.bie.velocity,
                                      input.bie_high.velocity, sizes.velocity)),
              input.physics.flow_gradient * points.position);
  // The run uses v of its forces, the elements that of the truncated forces in the file.
  if (input.bie.velocity_truncation.size() > 0) {
    velocity.further_error = SurfaceSeries(input.bie.velocity_truncation)(points);
  }
  list.push_back(std::move(velocity));
  if (input.physics.inextensible) list.push_back(constraint_residual(input, at, sizes.rate));
  return list;
}

}  // namespace vehd::fem_check
