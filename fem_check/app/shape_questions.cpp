#include <utility>

#include "fem_check/app/questions.hpp"

namespace vehd::fem_check {

std::vector<FieldQuestion> shape_questions(const CheckInput& input, const ComparisonPlaces& places) {
  const NaturalSizes sizes = natural_sizes(input, places);
  const QuestionMaker maker(places);
  std::vector<FieldQuestion> list;
  const auto question = [&](const std::string& name, const std::string& label, Eigen::MatrixXd BieFields::*field,
                            double size) {
    const Eigen::MatrixXd &judged = input.bie.*field, &high = input.bie_high.*field;
    FieldQuestion result = maker.on_surface(name, label, name, judged, judged, high, size);
    result.group = RowGroup::from_shape;
    return result;
  };
  if (input.physics.bending_modulus > 0.0) {
    list.push_back(question("bending", "f_b", &BieFields::force_bending, sizes.force));
    FieldQuestion work = question("bending", "f_b work", &BieFields::force_bending, sizes.force);
    work.name = "bending_work";
    list.push_back(work_on_smooth(std::move(work), places.surface));
  }
  if (input.bie.force_curvature.size() > 0) {
    list.push_back(question("spontaneous_curvature", "f_c", &BieFields::force_curvature, sizes.force));
  }
  if (input.physics.inextensible) {
    FieldQuestion tension = question("tension", "lambda", &BieFields::tension, sizes.force * places.radius);
    if (input.bie.tension_is_free) tension = without_uniform_tension(std::move(tension), places.surface);
    list.push_back(std::move(tension));
  }
  list.push_back(without(question("velocity", "v", &BieFields::velocity_of_shape, sizes.velocity),
                         input.physics.flow_gradient * places.surface.position));
  return list;
}

}  // namespace vehd::fem_check
