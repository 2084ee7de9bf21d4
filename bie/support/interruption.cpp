#include "bie/support/interruption.hpp"

#include <pthread.h>

#include <ctime>

namespace vehd {

Interruption::Interruption() {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  // Of all signals that request an end, mpirun forwards only this one.
  sigaddset(&signals_, SIGUSR1);
  pthread_sigmask(SIG_BLOCK, &signals_, &former_mask_);
}

Interruption::~Interruption() {
  // Signals that arrived meanwhile have been handled: drain them, or they would end the process once unblocked.
  while (requested()) requested_ = false;
  pthread_sigmask(SIG_SETMASK, &former_mask_, nullptr);
}

bool Interruption::requested() {
  const timespec at_once{};
  if (!requested_) requested_ = sigtimedwait(&signals_, nullptr, &at_once) > 0;
  return requested_;
}

}  // namespace vehd
