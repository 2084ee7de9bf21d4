#include "bie/pictures/shapes_key.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "bie/scene/model_of.hpp"
#include "bie/scene/shapes/placement.hpp"

namespace vehd {
namespace {

constexpr const char* field_colour = "#8a1c7c";
constexpr const char* flow_colour = "#1f5fa8";
constexpr const char* gravity_colour = "#444444";
constexpr double word_height = 13.0;
constexpr double word_size = 8.0;
/// A unit vector is drawn as a mark if its part in the plane of the picture is shorter.
constexpr double hardly_seen = 0.25;

using Plane = Eigen::Vector2d;
/// v_∞ at a point, without its waveform.
using Velocity = std::function<Vector3(const Vector3&)>;

PagePoint point(const Plane& at) { return {at.x(), at.y()}; }

Plane middle_of(const Box& box) { return {0.5 * (box.left + box.right), 0.5 * (box.bottom + box.top)}; }

void add_arrow(Page& page, const Plane& from, const Plane& to, const char* colour, bool both_ends = false) {
  constexpr double width = 1.1;
  page.lines.push_back({{point(from), point(to)}, width, colour, true});
  if (both_ends) page.lines.push_back({{point(to), point(from)}, width, colour, true});
}

std::vector<PagePoint> circle(const Plane& centre, double radius) {
  constexpr int n = 24;
  std::vector<PagePoint> points;
  for (int i = 0; i <= n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    points.push_back(point(centre + radius * Plane(std::cos(angle), std::sin(angle))));
  }
  return points;
}

/// An arrow seen from its tip, a circle with a dot, or from its end, a circle with a cross.
void add_mark(Page& page, const Plane& centre, bool towards_eye, const char* colour) {
  constexpr double radius = 6.0, dot = 1.6;
  page.lines.push_back({circle(centre, radius), 1.1, colour, false});
  if (towards_eye) {
    page.areas.push_back({circle(centre, dot), colour});
    return;
  }
  const double reach = radius * std::numbers::sqrt2 / 2.0;
  for (const double sign : {1.0, -1.0}) {
    const Plane arm(reach, sign * reach);
    page.lines.push_back({{point(centre - arm), point(centre + arm)}, 1.1, colour, false});
  }
}

/// Adds the word at the top of an item; returns the middle of the rest of its box.
Plane add_word(Page& page, const Box& box, const std::string& word, const char* colour) {
  page.texts.push_back(
      {word, {middle_of(box).x(), box.top - 0.5 * word_height}, word_size, TextAnchor::centre, colour});
  return middle_of({box.left, box.bottom, box.right, box.top - word_height});
}

void draw_axes(Page& page, const Box& box, const Matrix3& view) {
  constexpr double length = 22.0, beyond = 6.5;
  const std::array names{"x", "y", "z"};
  const Matrix tips = length * view.topRows<2>();
  const Plane low = tips.rowwise().minCoeff().cwiseMin(0.0), high = tips.rowwise().maxCoeff().cwiseMax(0.0);
  const Plane origin = middle_of(box) - 0.5 * (low + high);
  for (int axis = 0; axis < 3; ++axis) {
    const Plane tip = tips.col(axis);
    if (tip.norm() < hardly_seen * length) continue;
    add_arrow(page, origin, origin + tip, "#000000");
    page.texts.push_back({names[static_cast<std::size_t>(axis)], point(origin + tip + beyond * tip.normalized()),
                          word_size, TextAnchor::centre, "#000000"});
  }
}

void draw_vector(Page& page, const Plane& centre, const Vector3& vector, const Matrix3& view, const char* colour,
                 bool both_ends) {
  const Vector3 seen = view * vector.normalized();
  constexpr double length = 26.0;
  if (seen.head<2>().norm() < hardly_seen) {
    add_mark(page, centre, seen.z() > 0.0, colour);
  } else {
    const Plane half = 0.5 * length * seen.head<2>();
    add_arrow(page, centre - half, centre + half, colour, both_ends);
  }
}

Velocity velocity_of(const Scene& scene) {
  if (const std::optional<BackgroundFlow> linear = model_of(scene).flow) {
    return [gradient = linear->gradient](const Vector3& x) -> Vector3 { return gradient * x; };
  }
  return [flow = *scene.flow](const Vector3& x) -> Vector3 {
    const double distance = flow.section == FlowSection::slit ? x.z() : std::hypot(x.y(), x.z());
    return flow.centre_velocity * (1.0 - std::pow(distance / flow.radius, 2)) * Vector3::UnitX();
  };
}

/// Draws a velocity profile: arrows from a line across the flow.
void draw_profile(Page& page, const Plane& centre, const FlowScene& flow, const Velocity& v, const Matrix3& view,
                  const Vector3& across) {
  constexpr double reach = 16.0, longest = 17.0;
  const double radius = flow.kind == FlowKind::poiseuille ? flow.radius : 1.0;
  double fastest = 0.0;
  constexpr std::array places{-0.9, -0.45, 0.0, 0.45, 0.9};
  const auto velocity = [&](double place) -> Vector3 { return v(place * radius * across); };
  for (const double place : places) fastest = std::max(fastest, velocity(place).norm());
  // All arrows of a Poiseuille flow point to one side: they start upstream of the middle.
  const Plane shift = flow.kind == FlowKind::poiseuille
                          ? Plane(-0.5 * longest * (view * velocity(0.0)).head<2>() / std::max(fastest, 1e-300))
                          : Plane(Plane::Zero());
  const Plane line = (view * across).head<2>().normalized() * reach;
  page.lines.push_back({{point(centre + shift - line), point(centre + shift + line)}, 0.6, flow_colour, false});
  for (const double place : places) {
    const Plane arrow = longest / fastest * (view * velocity(place)).head<2>();
    const Plane start = centre + shift + place * line;
    if (arrow.norm() > 0.1 * longest) add_arrow(page, start, start + arrow, flow_colour);
  }
}

/// Draws arrows around a circle in the plane of the picture; false if the flow has no part in this plane.
bool draw_ring(Page& page, const Plane& centre, const Velocity& v, const Matrix3& view) {
  constexpr int n = 8;
  constexpr double radius = 13.0, longest = 9.0;
  std::array<Plane, n> places, arrows;
  double fastest = 0.0, fastest_seen = 0.0;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    places[i] = {std::cos(angle), std::sin(angle)};
    const Vector3 velocity = view * v(view.topRows<2>().transpose() * places[i]);
    arrows[i] = velocity.head<2>();
    fastest = std::max(fastest, velocity.norm());
    fastest_seen = std::max(fastest_seen, arrows[i].norm());
  }
  if (fastest_seen <= hardly_seen * fastest || fastest == 0.0) return false;
  for (int i = 0; i < n; ++i) {
    const Plane arrow = longest / fastest_seen * arrows[i];
    if (arrow.norm() < 0.2 * longest) continue;
    // Inward arrows end on the circle, outward ones begin there, those along it have their middle there.
    const double outward = arrow.dot(places[i]) / arrow.norm();
    const Plane start = centre + radius * places[i] - 0.5 * (1.0 - outward) * arrow;
    add_arrow(page, start, start + arrow, flow_colour);
  }
  return true;
}

void draw_flow(Page& page, const Plane& centre, const Scene& scene, const Matrix3& view) {
  const FlowScene& flow = *scene.flow;
  const Velocity v = velocity_of(scene);
  const auto seen = [&view](const Vector3& direction) { return (view * direction).head<2>().norm() > 0.5; };
  const bool shear = flow.kind == FlowKind::shear, poiseuille = flow.kind == FlowKind::poiseuille;
  if ((shear || poiseuille) && seen(Vector3::UnitX())) {
    if (seen(Vector3::UnitZ())) return draw_profile(page, centre, flow, v, view, Vector3::UnitZ());
    if (poiseuille && flow.section == FlowSection::tube)
      return draw_profile(page, centre, flow, v, view, Vector3::UnitY());
  }
  if (draw_ring(page, centre, v, view)) return;
  // The flow has no part in the plane: shows it on the side of the eye.
  const Vector3 near = v(view.row(2).transpose());
  if (near.norm() > 0.0) draw_vector(page, centre, near, view, flow_colour, false);
}

void draw_scale_bar(Page& page, const Box& box, const KeyTask& task) {
  constexpr double longest = 52.0, thickness = 1.6;
  const double number = round_below(longest / task.scale * task.length.factor);
  const double length = number / task.length.factor * task.scale;
  const Plane middle = middle_of(box);
  const double y = box.bottom + 7.0;
  page.lines.push_back({{{middle.x() - 0.5 * length, y}, {middle.x() + 0.5 * length, y}}, thickness, "#000000", false});
  const std::string text = distinct_texts({number}).front();
  page.texts.push_back({task.length.unit.empty() ? text : text + " " + task.length.unit,
                        {middle.x(), y + 9.0},
                        word_size,
                        TextAnchor::centre,
                        "#000000"});
}

bool alternates(const std::optional<WaveformScene>& waveform) { return waveform && alternates(*waveform); }

}  // namespace

std::vector<KeyItem> key_items(const Scene& scene) {
  std::vector<KeyItem> items{KeyItem::axes};
  if (scene.electric && vector_of(scene.electric->field).norm() > 0.0) items.push_back(KeyItem::field);
  if (scene.gravity && vector_of(scene.gravity->acceleration).norm() > 0.0) items.push_back(KeyItem::gravity);
  if (scene.flow) items.push_back(KeyItem::flow);
  items.push_back(KeyItem::scale_bar);
  return items;
}

double key_height(KeyItem item) {
  switch (item) {
    case KeyItem::axes:
      return 50.0;
    case KeyItem::field:
    case KeyItem::gravity:
      return 46.0;
    case KeyItem::flow:
      return 62.0;
    case KeyItem::scale_bar:
      return 26.0;
  }
  return 0.0;
}

void draw_key_item(Page& page, KeyItem item, const Box& box, const KeyTask& task) {
  switch (item) {
    case KeyItem::axes:
      return draw_axes(page, box, task.view);
    case KeyItem::field:
      return draw_vector(page, add_word(page, box, "field", field_colour), vector_of(task.scene.electric->field),
                         task.view, field_colour, alternates(task.scene.electric->waveform));
    case KeyItem::gravity:
      return draw_vector(page, add_word(page, box, "gravity", gravity_colour),
                         vector_of(task.scene.gravity->acceleration), task.view, gravity_colour, false);
    case KeyItem::flow:
      return draw_flow(page, add_word(page, box, "flow", flow_colour), task.scene, task.view);
    case KeyItem::scale_bar:
      return draw_scale_bar(page, box, task);
  }
}

}  // namespace vehd
