#include "bie/runs/given_times.hpp"

#include <fmt/format.h>

#include "bie/runs/run_directory.hpp"
#include "bie/runs/run_files.hpp"
#include "bie/scene/given_time.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

GivenTimes::GivenTimes(const RunReader& run, const std::filesystem::path& file) : file_(file.string()) {
  if (run.has_scene()) scales_ = parse_units(run.scene(), file_ + " (scene)");
  const RunPaths beside{file.parent_path()};
  if (std::filesystem::exists(beside.history()) || std::filesystem::exists(beside.checkpoint())) {
    ReadingNotes notes;
    unit_ = units_of_run(beside, scales_, notes).of("time");
  } else if (!scales_ || !scales_->time) {
    unit_ = OutputUnit{};
  }
}

double GivenTimes::number_of(const std::string& text) const {
  try {
    return number_of_time(text, scales_, unit_);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", file_, error.what()));
  }
}

SiUnit GivenTimes::shown() const {
  if (unit_) return unit_->is_si() ? SiUnit{unit_->symbol, unit_->factor} : SiUnit{};
  return {"s", *scales_->time};
}

}  // namespace vehd
