#include <utility>

#include "fem_check/app/compared_fields.hpp"
#include "fem_check/app/smooth_work.hpp"

namespace vehd::fem_check {

std::vector<ComparedField> fields_of_shape(const CheckInput& input, const ComparisonPoints& at, const Level& of_shape) {
  const NaturalSizes sizes = natural_sizes(input, at);
  std::vector<ComparedField> list;
  // With two vesicles, only one of them may bend or have a spontaneous curvature.
  const auto has = [&](const char* name, Eigen::MatrixXd BieFields::*field) {
    return of_shape.surface.contains(name) && (input.bie.*field).size() > 0;
  };
  const auto field_of = [&](const std::string& name, const std::string& label, Eigen::MatrixXd BieFields::*field,
                            double size) {
    const Eigen::MatrixXd &judged = input.bie.*field, &high = input.bie_high.*field;
    ComparedField result = field_on_surface(at, name, label, name, judged, judged, high, size);
    result.group = RowGroup::from_shape;
    return result;
  };
  if (has("bending", &BieFields::force_bending)) {
    ComparedField bending = field_of("bending", "f_b", &BieFields::force_bending, sizes.force);
    ComparedField work = bending;
    bending.has_work_row = true;
    list.push_back(std::move(bending));
    work.name = "bending_work";
    work.label = "f_b, work";
    list.push_back(work_on_smooth(std::move(work), at.surface));
  }
  if (has("spontaneous_curvature", &BieFields::force_curvature)) {
    list.push_back(field_of("spontaneous_curvature", "f_c", &BieFields::force_curvature, sizes.force));
  }
  if (has("tension", &BieFields::tension)) {
    ComparedField tension = field_of("tension", "lambda", &BieFields::tension, sizes.force * at.radius);
    if (input.bie.tension_is_free) tension = without_uniform_tension(std::move(tension), at.surface);
    list.push_back(std::move(tension));
  }
  if (has("velocity", &BieFields::velocity_of_shape)) {
    list.push_back(without(field_of("velocity", "v", &BieFields::velocity_of_shape, sizes.velocity),
                           input.physics.flow_gradient * at.surface.position));
  }
  return list;
}

}  // namespace vehd::fem_check
