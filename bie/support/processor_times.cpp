#include "bie/support/processor_times.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace vehd {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

double idle_seconds(const std::string& stat, double ticks_per_second) {
  std::istringstream line(stat);
  std::string name;
  double user = 0.0, nice = 0.0, system = 0.0, idle = 0.0, waiting = 0.0;
  if (!(line >> name >> user >> nice >> system >> idle >> waiting) || name != "cpu") {
    throw std::invalid_argument("no first line of /proc/stat: " + stat.substr(0, stat.find('\n')));
  }
  return (idle + waiting) / ticks_per_second;
}

ProcessorTimes processor_times() {
  ProcessorTimes now;
  now.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  rusage use{};
  ::getrusage(RUSAGE_SELF, &use);
  now.own = seconds(use.ru_utime) + seconds(use.ru_stime);
  std::ifstream file("/proc/stat");
  std::string line;
  now.idle = std::getline(file, line) ? idle_seconds(line, static_cast<double>(::sysconf(_SC_CLK_TCK)))
                                      : now.elapsed * static_cast<double>(::sysconf(_SC_NPROCESSORS_ONLN));
  return now;
}

int processors_left(const ProcessorTimes& begin, const ProcessorTimes& end, int most) {
  const double elapsed = end.elapsed - begin.elapsed;
  if (!(elapsed > 0.0)) return most;
  const double left = (end.idle - begin.idle + end.own - begin.own) / elapsed;
  return static_cast<int>(std::lround(std::clamp(left, 1.0, static_cast<double>(std::max(most, 1)))));
}

}  // namespace vehd
