#pragma once

#include <string>

namespace vehd {

/// Seconds since some start, of this process and of the machine.
struct ProcessorTimes {
  double elapsed = 0.0;
  double idle = 0.0;  ///< of all processors of the machine together, nothing ran
  double own = 0.0;   ///< of all processors together, this process ran
};

/// Now. Where the system does not tell, the machine is idle.
ProcessorTimes processor_times();

/// Seconds in which no processor had work, from the text of /proc/stat: its first line counts ticks of each kind.
/// @throws std::invalid_argument if it is another text
double idle_seconds(const std::string& stat, double ticks_per_second);

/// Processors that others left between two times: used by this process or idle, to the nearest number.
/// @param most  that this process may use
/// @return      1 to most
int processors_left(const ProcessorTimes& begin, const ProcessorTimes& end, int most);

}  // namespace vehd
