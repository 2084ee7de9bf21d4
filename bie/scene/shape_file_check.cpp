#include "bie/scene/shape_file_check.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "bie/scene/shape_file.hpp"
#include "bie/scene/toml_values.hpp"
#include "bie/scene/units.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

class ShapeFileCheck {
 public:
  ShapeFileCheck(Scene& scene, const toml::table& table, const std::string& file)
      : scene_(scene), table_(table), file_(file) {}

  void run() {
    if (scene_.shape.kind != ShapeKind::file) {
      if (takes_stored_potential(scene_)) {
        refuse("electric", "initial_Vm",
               "\"initial_Vm\" in [electric] is file, but the shape is from none; accepted: zero, steady");
      }
      return;
    }
    require_file();
    const RunReader run(scene_.shape.path);
    if (run.n_vesicles() > 1) {
      refuse("shape", "path",
             fmt::format("\"path\" in [shape] is {}, which holds {} vesicles; accepted: a run of one",
                         scene_.shape.path, run.n_vesicles()));
    }
    const auto units = units_of(run);
    if (!scene_.shape.area) {
      require_scale(units, {"length", &UnitsScene::length}, "shape", "path",
                    "\"area\" in [shape], which sets the size");
    }
    if (scene_.shape.time) {
      require_scale(units, {"time", &UnitsScene::time}, "shape", "time", "no \"time\", for the last snapshot");
      require_snapshot(run, *conversion(units, scene_.units, &UnitsScene::time));
    }
    if (scene_.electric && !has_averaged_field(scene_) && !has_relaxing_charge(scene_)) check_potential(units);
  }

 private:
  struct Scale {
    std::string_view name;
    std::optional<double> UnitsScene::*value;
  };

  [[noreturn]] void refuse(std::string_view table, std::string_view key, const std::string& problem) const {
    refuse_key(table_, table, key, file_, problem);
  }

  void require_file() const {
    std::error_code error;
    if (std::filesystem::is_regular_file(scene_.shape.path, error)) return;
    refuse("shape", "path", fmt::format("\"path\" in [shape] is {}: no such file", scene_.shape.path));
  }

  /// @param way_out  what makes the scale unnecessary
  void require_scale(const std::optional<UnitsScene>& of_run, const Scale& scale, std::string_view table,
                     std::string_view key, std::string_view way_out) const {
    if (conversion(of_run, scene_.units, scale.value)) return;
    const bool run_has_it = of_run && *of_run.*scale.value;
    const std::string accepted =
        run_has_it ? fmt::format("\"{}\" in [units]", scale.name) : "a run of a scene with [units]";
    refuse(table, key,
           fmt::format("\"{}\" in [{}] needs a reference {}, which {} has and {} has not; accepted: {}, or {}", key,
                       table, scale.name, run_has_it ? scene_.shape.path : "this scene",
                       run_has_it ? "this scene" : scene_.shape.path, accepted, way_out));
  }

  void require_snapshot(const RunReader& run, double scene_time_of_one) const {
    const double time = *scene_.shape.time / scene_time_of_one;
    if (run.find(time)) return;
    refuse("shape", "time",
           fmt::format("\"time\" in [shape] is {:g}, at which {} has no snapshot; the nearest is at {:g}",
                       *scene_.shape.time, scene_.shape.path, run.times()[run.nearest(time)] * scene_time_of_one));
  }

  void check_potential(const std::optional<UnitsScene>& of_run) {
    const bool is_said = table_["electric"]["initial_Vm"].is_string();
    const bool is_there = ShapeFile(scene_).has_potential();
    if (!is_said && is_there) scene_.electric->initial_potential = InitialPotential::file;
    if (!takes_stored_potential(scene_)) return;
    if (!is_there) {
      refuse("electric", "initial_Vm",
             fmt::format("\"initial_Vm\" in [electric] is file, but {} has no V_m; accepted: zero, steady",
                         scene_.shape.path));
    }
    require_scale(of_run, {"potential", &UnitsScene::potential}, "electric", "initial_Vm",
                  "\"initial_Vm\" zero or steady");
  }

  Scene& scene_;
  const toml::table& table_;
  const std::string& file_;
};

}  // namespace

void check_shape_file(Scene& scene, const toml::table& table, const std::string& file) {
  ShapeFileCheck(scene, table, file).run();
}

}  // namespace vehd
