#include "fem_check/app/compared_fields.hpp"

#include <cmath>
#include <utility>

namespace vehd::fem_check {
namespace {

/// Whether each sample point was found on every level.
std::vector<bool> found_by_all(const LevelSequence& sequence, const std::string& values, std::size_t n_samples) {
  std::vector<bool> found(n_samples, true);
  const auto look_at = [&](const Level& level) {
    const auto at = level.samples.find(values);
    for (std::size_t i = 0; i < n_samples; ++i) {
      found[i] = found[i] && at != level.samples.end() && at->second.cols() == static_cast<Eigen::Index>(n_samples) &&
                 at->second.col(static_cast<Eigen::Index>(i)).allFinite();
    }
  };
  for (const Level& level : sequence.levels) look_at(level);
  look_at(sequence.truncated);
  look_at(sequence.loose);
  return found;
}

class ComparedFields {
 public:
  ComparedFields(const CheckInput& input, const ComparisonPoints& at, const LevelSequence& sequence)
      : input_(input), sequence_(sequence), at_(at) {}

  [[nodiscard]] ComparedField on_surface(const std::string& name, const std::string& label,
                                         Eigen::MatrixXd BieFields::*field, double size) const {
    return field_on_surface(at_, name, label, name, input_.bie.*field, input_.bie.*field, input_.bie_high.*field, size);
  }

  /// A field minus `background`, [components x samples], at the samples inside, outside and near γ apart.
  void at_samples(const std::string& name, const std::string& symbol, Eigen::MatrixXd BieFields::*field, double size,
                  const Eigen::MatrixXd& background) {
    if ((input_.bie.*field).size() == 0) return;
    const Samples& samples = input_.samples;
    const std::vector<bool> found = found_by_all(sequence_, name, samples.near.size());
    const Eigen::MatrixXd left = (input_.bie.*field).transpose() - background;
    const double whole = std::sqrt(left.squaredNorm() / static_cast<double>(left.cols()));
    const auto group = [&](const std::string& place, const auto& belongs) {
      std::vector<Eigen::Index> columns;
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i] && belongs(i)) columns.push_back(static_cast<Eigen::Index>(i));
      }
      if (columns.empty()) return;
      ComparedField compared;
      compared.name = name + "_" + place;
      compared.label = symbol + " " + place;
      compared.values = name;
      compared.is_sample = true;
      compared.columns = columns;
      compared.judged = (input_.bie.*field)(columns, Eigen::all).transpose();
      compared.bie = compared.judged;
      compared.bie_high = (input_.bie_high.*field)(columns, Eigen::all).transpose();
      compared.degrees = {input_.bie.order, input_.bie_high.order, {}};
      compared.weight = Vector::Ones(static_cast<Eigen::Index>(columns.size()));
      compared.natural_size = size;
      compared.whole_size = whole;
      list.push_back(without(std::move(compared), background(Eigen::all, columns)));
    };
    group("inside", [&](std::size_t i) { return !samples.near[i] && samples.inside[i]; });
    group("outside", [&](std::size_t i) { return !samples.near[i] && !samples.inside[i]; });
    group("near", [&](std::size_t i) { return bool{samples.near[i]}; });
  }

  std::vector<ComparedField> list;

 private:
  const CheckInput& input_;
  const LevelSequence& sequence_;
  const ComparisonPoints& at_;
};

}  // namespace

std::vector<ComparedField> electric_fields(const CheckInput& input, const ComparisonPoints& at,
                                           const LevelSequence& sequence) {
  const NaturalSizes sizes = natural_sizes(input, at);
  ComparedFields fields(input, at, sequence);
  fields.list.push_back(fields.on_surface("q", "q", &BieFields::charge, sizes.charge));
  if (input.charged_faces()) {
    fields.list.push_back(
        fields.on_surface("Vm_of_charges", "V_m of charges", &BieFields::potential_of_charges, sizes.potential));
  }
  if (input.steady()) {
    fields.list.push_back(fields.on_surface("Vm", "V_m steady", &BieFields::steady_potential, sizes.potential));
    ComparedField& steady =
        fields.list.emplace_back(fields.on_surface("q_steady", "q steady", &BieFields::steady_charge, sizes.charge));
    // The flux G_m V_m/σ of a small V_m, the difference of two large potentials.
    for (const double conductivity : {input.physics.conductivity_in, input.physics.conductivity_out}) {
      if (conductivity > 0.0) steady.solver_magnification += input.physics.conductance * at.radius / conductivity;
    }
  }
  fields.list.push_back(fields.on_surface("force", "f_E", &BieFields::force_electric, sizes.electric_force));
  // Without the potential of the field at the centre of the shape, which would dominate far from the origin.
  const double at_centre = -input.physics.field.dot(at.centre);
  fields.at_samples("potential", "phi", &BieFields::sample_potential, sizes.potential,
                    Eigen::MatrixXd::Constant(1, input.samples.points.cols(), at_centre));
  return std::move(fields.list);
}

std::vector<ComparedField> flow_fields(const CheckInput& input, const ComparisonPoints& at,
                                       const LevelSequence& sequence) {
  const NaturalSizes sizes = natural_sizes(input, at);
  const Eigen::MatrixXd background = input.physics.flow_gradient * at.surface.position;
  ComparedFields fields(input, at, sequence);
  const auto add = [&](const std::string& name, const std::string& label, Eigen::MatrixXd BieFields::*field) {
    fields.list.push_back(without(fields.on_surface(name, label, field, sizes.velocity), background));
  };
  add("velocity", "v", &BieFields::velocity);
  if (input.electric()) add("velocity_own_force", "v, own f_E", &BieFields::velocity_own_force);
  fields.at_samples("velocity", "v", &BieFields::sample_velocity, sizes.velocity,
                    input.physics.flow_gradient * input.samples.points);
  return std::move(fields.list);
}

}  // namespace vehd::fem_check
