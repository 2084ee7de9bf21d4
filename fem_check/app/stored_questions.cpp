#include <utility>

#include "fem_check/app/questions.hpp"
#include "fem_check/app/smooth_work.hpp"
#include "fem_check/app/surface_divergence.hpp"
#include "fem_check/app/surface_series.hpp"

namespace vehd::fem_check {
namespace {

FieldQuestion stored(FieldQuestion question) {
  question.group = RowGroup::stored;
  return question;
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
FieldQuestion charging_question(const CheckInput& input, const ComparisonPlaces& places, const NaturalSizes& sizes,
                                const QuestionMaker& maker) {
  const Physics& physics = input.physics;
  const Eigen::MatrixXd rate = physics.capacitance * input.bie.potential_rate;
  FieldQuestion question =
      maker.on_surface("charging_current", input.charged_faces() ? "dq_i/dt" : "C dV_m/dt", "flux_in", rate, rate,
                       physics.capacitance * input.bie_high.potential_rate, sizes.current);
  question.is_remainder = true;
  // The run uses G_m of the state of the pores, the elements the truncated G_m of the file.
  if (input.bie.rate_truncation.size() > 0) {
    question.further_error = physics.capacitance * SurfaceSeries(input.bie.rate_truncation)(places.surface);
  }
  const Eigen::MatrixXd leak = current_through(input, places.surface);
  question.from_level = [leak, sigma = physics.conductivity_in](const Eigen::MatrixXd& flux_in) {
    return Eigen::MatrixXd(-sigma * flux_in - leak);
  };
  return question;
}

/// σ_i E_i − σ_e E_e, the rate of change of the free charge of both faces; it is not stored in snapshots.
FieldQuestion free_current_question(const CheckInput& input, const NaturalSizes& sizes, const QuestionMaker& maker) {
  const double capacitance = input.physics.capacitance;
  const Eigen::MatrixXd rate = capacitance * input.bie.free_charge_rate;
  FieldQuestion question = maker.on_surface("free_current", "dQ_f/dt", "free_current", rate, rate,
                                            capacitance * input.bie_high.free_charge_rate, sizes.current);
  question.is_remainder = true;
  return question;
}

/// ∇_γ·v of the stored velocity minus the value that the constraint prescribes; the residuals of the boundary integrals
/// at both orders are the error.
FieldQuestion divergence_question(const CheckInput& input, const ComparisonPlaces& places, double rate) {
  const SurfacePoints& points = places.surface;
  const auto left = [&](const Eigen::MatrixXd& velocity, double dilation) {
    const Vector divergence = surface_divergence(input.position, velocity, points.direction);
    return Eigen::MatrixXd((divergence.array() - dilation).matrix().transpose());
  };
  const Eigen::MatrixXd at_order = left(input.bie.velocity_of_shape, input.bie.dilation),
                        for_error = left(input.bie_high.velocity_of_shape, input.bie_high.dilation);
  FieldQuestion question;
  question.name = "surface_divergence";
  question.label = "div_S v";
  question.judge = Judge::constraint;
  question.group = RowGroup::stored;
  question.is_remainder = true;
  question.natural_size = rate;
  question.weight = points.weight;
  question.judged = left(input.stored.velocity, input.bie.dilation);
  question.bie = Eigen::MatrixXd::Zero(1, points.size());
  question.bie_high = question.bie;
  question.further_error = (at_order - for_error).cwiseAbs() + for_error.cwiseAbs();
  return question;
}

}  // namespace

std::vector<FieldQuestion> stored_electric_questions(const CheckInput& input, const ComparisonPlaces& places) {
  const NaturalSizes sizes = natural_sizes(input, places);
  const QuestionMaker maker(places);
  std::vector<FieldQuestion> list{
      stored(
          maker.on_surface("q", "q", "q", input.stored.charge, input.bie.charge, input.bie_high.charge, sizes.charge)),
      stored(maker.on_surface("force", "f_E", "force", input.stored.force_electric, input.bie.force_electric,
                              input.bie_high.force_electric, sizes.electric_force))};
  if (!input.charged_faces()) return list;
  list.push_back(
      stored(maker.on_surface("Vm_of_charges", "V_m", "Vm_of_charges", input.potential, input.bie.potential_of_charges,
                              input.bie_high.potential_of_charges, sizes.potential)));
  return list;
}

std::vector<FieldQuestion> current_questions(const CheckInput& input, const ComparisonPlaces& places) {
  const NaturalSizes sizes = natural_sizes(input, places);
  const QuestionMaker maker(places);
  std::vector<FieldQuestion> list{charging_question(input, places, sizes, maker)};
  if (input.charged_faces()) list.push_back(free_current_question(input, sizes, maker));
  return list;
}

FieldQuestion in_time_question(const CheckInput& input, const ComparisonPlaces& places,
                               const ChargingLevels& charging) {
  const InTime& in_time = *input.in_time;
  FieldQuestion question = QuestionMaker(places).on_surface("Vm", "V_m", "Vm", input.potential, in_time.bie,
                                                            in_time.bie_high, natural_sizes(input, places).potential);
  question.group = RowGroup::in_time;
  question.time_error = charging.time_error;
  // The change is due to degrees and steps together.
  question.degrees = {};
  // For steps of first order the error is 4/3 of the change by quartering them: twice the change is counted.
  question.further_error = (question.bie - question.bie_high).cwiseAbs();
  if (in_time.by_motion.size() > 0) {
    question.further_error += 2.0 * SurfaceSeries(in_time.by_motion)(places.surface).cwiseAbs();
  }
  return question;
}

namespace {

/// Stored fields determined by the shape, with the boundary integrals as reference, and with the elements if these
/// provide the field.
class StoredOfShape {
 public:
  StoredOfShape(const CheckInput& input, const ComparisonPlaces& places, const Level* of_shape)
      : input_(input), places_(places), sizes_(natural_sizes(input, places)), of_shape_(of_shape) {}

  void add_bending() {
    if (input_.stored.force_bending.size() == 0) return;
    FieldQuestion field = question("force_bending", "f_b", input_.stored.force_bending, &BieFields::force_bending);
    FieldQuestion work = field;
    field.has_work_row = elements_have("bending");
    list.push_back(std::move(field));
    if (!elements_have("bending")) return;
    work.name = "force_bending_work";
    work.label = "f_b, work";
    let_elements_judge(work, "bending");
    list.push_back(work_on_smooth(std::move(work), places_.surface));
  }

  void add_tension() {
    if (input_.stored.tension.size() == 0) return;
    FieldQuestion field = question("force_tension", "f_lambda", input_.stored.force_tension, &BieFields::force_tension);
    FieldQuestion tension = question("tension", "lambda", input_.stored.tension, &BieFields::tension);
    tension.natural_size *= places_.radius;
    FieldQuestion work = field;
    field.has_work_row = elements_have("tension");
    list.push_back(std::move(field));
    if (elements_have("tension")) {
      work.name = "force_tension_work";
      work.label = "f_lambda, work";
      for (FieldQuestion* each : {&work, &tension}) let_elements_judge(*each, "tension");
      list.push_back(work_of_tension(std::move(work), input_.position, places_.surface));
    }
    list.push_back(std::move(tension));
  }

  std::vector<FieldQuestion> list;

 private:
  [[nodiscard]] bool elements_have(const std::string& values) const {
    return of_shape_ != nullptr && of_shape_->surface.contains(values);
  }
  /// Question with the boundary integrals as the only reference.
  [[nodiscard]] FieldQuestion question(const std::string& name, const std::string& label, const Eigen::MatrixXd& judged,
                                       Eigen::MatrixXd BieFields::*field) const {
    FieldQuestion result = stored(QuestionMaker(places_).on_surface(name, label, "", judged, input_.bie.*field,
                                                                    input_.bie_high.*field, sizes_.force));
    result.judge = Judge::boundary_integrals;
    if (name != "force_bending" && input_.bie.tension_is_free) {
      result = without_uniform_tension(std::move(result), places_.surface);
    }
    return result;
  }
  static void let_elements_judge(FieldQuestion& question, const std::string& values) {
    question.judge = Judge::elements;
    question.values = values;
  }

  const CheckInput& input_;
  const ComparisonPlaces& places_;
  NaturalSizes sizes_;
  const Level* of_shape_;
};

}  // namespace

std::vector<FieldQuestion> stored_shape_questions(const CheckInput& input, const ComparisonPlaces& places,
                                                  const Level* of_shape) {
  StoredOfShape questions(input, places, of_shape);
  questions.add_bending();
  questions.add_tension();
  return std::move(questions.list);
}

std::vector<FieldQuestion> stored_flow_questions(const CheckInput& input, const ComparisonPlaces& places) {
  const NaturalSizes sizes = natural_sizes(input, places);
  const SurfacePoints& points = places.surface;
  std::vector<FieldQuestion> list;
  FieldQuestion velocity =
      without(stored(QuestionMaker(places).on_surface("velocity", "v", "velocity", input.stored.velocity,
                                                      input.bie.velocity, input.bie_high.velocity, sizes.velocity)),
              input.physics.flow_gradient * points.position);
  // The run uses v of its forces, the elements that of the truncated forces in the file.
  if (input.bie.velocity_truncation.size() > 0) {
    velocity.further_error = SurfaceSeries(input.bie.velocity_truncation)(points);
  }
  list.push_back(std::move(velocity));
  if (input.physics.inextensible) list.push_back(divergence_question(input, places, sizes.rate));
  return list;
}

}  // namespace vehd::fem_check
