#pragma once

#include <string>

namespace vehd {

/// Seconds since an arbitrary origin, of this process and of the machine.
struct ProcessorTimes {
  double elapsed = 0.0;
  double idle = 0.0;  ///< idle time, summed over all processors of the machine
  double own = 0.0;   ///< processor time of this process, summed over all processors
};

/// Present times. If the system does not report idle times, the machine counts as idle.
ProcessorTimes processor_times();

/// Idle time of all processors, from the text of /proc/stat: its first line counts ticks of each kind.
/// @throws std::invalid_argument if the text is not of that form
double idle_seconds(const std::string& stat, double ticks_per_second);

/// Processors available between two times: used by this process or idle, rounded to an integer.
/// @param most  number that this process may use
/// @return      1 to most
int processors_left(const ProcessorTimes& begin, const ProcessorTimes& end, int most);

}  // namespace vehd
