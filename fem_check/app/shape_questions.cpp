#include <utility>

#include "fem_check/app/questions.hpp"
#include "fem_check/app/smooth_work.hpp"

namespace vehd::fem_check {

std::vector<FieldQuestion> shape_questions(const CheckInput& input, const ComparisonPlaces& places,
                                           const Level& of_shape) {
  const NaturalSizes sizes = natural_sizes(input, places);
  const QuestionMaker maker(places);
  std::vector<FieldQuestion> list;
  // With two vesicles, only one of them may bend or have a spontaneous curvature.
  const auto has = [&](const char* name, Eigen::MatrixXd BieFields::*field) {
    return of_shape.surface.contains(name) && (input.bie.*field).size() > 0;
  };
  const auto question = [&](const std::string& name, const std::string& label, Eigen::MatrixXd BieFields::*field,
                            double size) {
    const Eigen::MatrixXd &judged = input.bie.*field, &high = input.bie_high.*field;
    FieldQuestion result = maker.on_surface(name, label, name, judged, judged, high, size);
    result.group = RowGroup::from_shape;
    return result;
  };
  if (has("bending", &BieFields::force_bending)) {
    FieldQuestion bending = question("bending", "f_b", &BieFields::force_bending, sizes.force);
    FieldQuestion work = bending;
    bending.has_work_row = true;
    list.push_back(std::move(bending));
    work.name = "bending_work";
    work.label = "f_b, work";
    list.push_back(work_on_smooth(std::move(work), places.surface));
  }
  if (has("spontaneous_curvature", &BieFields::force_curvature)) {
    list.push_back(question("spontaneous_curvature", "f_c", &BieFields::force_curvature, sizes.force));
  }
  if (has("tension", &BieFields::tension)) {
    FieldQuestion tension = question("tension", "lambda", &BieFields::tension, sizes.force * places.radius);
    if (input.bie.tension_is_free) tension = without_uniform_tension(std::move(tension), places.surface);
    list.push_back(std::move(tension));
  }
  if (has("velocity", &BieFields::velocity_of_shape)) {
    list.push_back(without(question("velocity", "v", &BieFields::velocity_of_shape, sizes.velocity),
                           input.physics.flow_gradient * places.surface.position));
  }
  return list;
}

}  // namespace vehd::fem_check
