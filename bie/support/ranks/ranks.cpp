#include "bie/support/ranks/ranks.hpp"

#include <algorithm>

#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {

namespace {

// The first letter of a message names the collective call.
constexpr char kGather = 'g', kExchange = 'x', kMeet = 'm', kFailed = 'f';
// The second letter of a failure names its class.
constexpr char kConvergence = 'c', kInput = 'i', kShape = 's', kOutput = 'o', kLogic = 'l', kOther = 'e';

template <typename Error>
class AgreedError : public Error, public Agreed {
 public:
  using Error::Error;
};

std::string failure_text(const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const ConvergenceError& error) {
    return kConvergence + std::string(error.what());
  } catch (const InputError& error) {
    return kInput + std::string(error.what());
  } catch (const ShapeError& error) {
    return kShape + std::string(error.what());
  } catch (const OutputError& error) {
    return kOutput + std::string(error.what());
  } catch (const std::logic_error& error) {
    return kLogic + std::string(error.what());
  } catch (const std::exception& error) {
    return kOther + std::string(error.what());
  } catch (...) {
    return kOther + std::string("unknown");
  }
}

[[noreturn]] void throw_failure(const std::string& failure) {
  const std::string text = failure.substr(1);
  switch (failure.front()) {
    case kConvergence:
      throw AgreedError<ConvergenceError>(text);
    case kInput:
      throw AgreedError<InputError>(text);
    case kShape:
      throw AgreedError<ShapeError>(text);
    case kOutput:
      throw AgreedError<OutputError>(text);
    case kLogic:
      throw AgreedError<std::logic_error>(text);
    default:
      throw AgreedError<std::runtime_error>(text);
  }
}

}  // namespace

std::vector<std::string> Ranks::gather_as(char call, const std::string& own) const {
  std::vector<std::string> all = link_->gather(call + own);
  for (const std::string& of_rank : all) {
    if (of_rank.front() == kFailed) throw_failure(of_rank.substr(1));
  }
  for (std::string& of_rank : all) {
    if (of_rank.front() != all.front().front()) {
      throw AgreedError<std::logic_error>(
          "the ranks have taken different decisions; accepted: processors of one kind, which round alike");
    }
  }
  for (std::string& of_rank : all) of_rank.erase(0, 1);
  return all;
}

std::vector<std::string> Ranks::gather(std::string own) const {
  if (is_alone()) return {std::move(own)};
  return gather_as(kGather, own);
}

std::vector<std::string> Ranks::exchange(const std::vector<std::string>& to) const {
  if (is_alone()) return to;
  (void)gather_as(kExchange, {});
  return link_->exchange(to);
}

bool Ranks::any(bool own) const {
  const std::vector<std::string> all = gather(own ? "1" : "0");
  return std::ranges::find(all, "1") != all.end();
}

void Ranks::meet() const {
  if (!is_alone()) (void)gather_as(kMeet, {});
}

void Ranks::fail(const std::exception_ptr& exception) const {
  (void)gather_as(kFailed, failure_text(exception));
  // Not reached: gather_as throws the failure on this rank as well.
  std::rethrow_exception(exception);
}

}  // namespace vehd
