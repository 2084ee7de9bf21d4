#include "bie/runs/sweep/claim.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <csignal>
#include <thread>
#include <vector>

#include "bie/support/interruption.hpp"
#include "tests/support/files.hpp"
#include "tests/support/waiting.hpp"

BOOST_AUTO_TEST_SUITE(claims)

namespace {

namespace fs = std::filesystem;
using vehd::Claim;

struct RunFolder {
  TemporaryDirectory directory;
  fs::path run = directory / "runs/a";

  /// Leaves the claim of a worker on another machine.
  void claim_elsewhere(int number) const {
    fs::create_directories(run);
    write_text(run / ("claim." + std::to_string(number)), "another machine");
  }
  /// Moves the time of a claim back.
  void age_claim(int number, int seconds) const {
    fs::last_write_time(run / ("claim." + std::to_string(number)),
                        fs::file_time_type::clock::now() - std::chrono::seconds(seconds));
  }
  [[nodiscard]] std::chrono::seconds age_of_claim(int number) const {
    return std::chrono::duration_cast<std::chrono::seconds>(
        fs::file_time_type::clock::now() - fs::last_write_time(run / ("claim." + std::to_string(number))));
  }
};

/// A process that does this work and then waits until it is killed.
template <typename Work>
pid_t waiting_process(const Work& work) {
  const pid_t process = ::fork();
  if (process == 0) {
    const auto kept = work();
    ::pause();
    ::_exit(0);
  }
  return process;
}

void end_process(pid_t process) {
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
}

}  // namespace

BOOST_FIXTURE_TEST_CASE(a_run_belongs_to_the_first_that_claims_it, RunFolder) {
  auto claim = Claim::take(run);
  BOOST_TEST_REQUIRE(claim != nullptr);
  BOOST_TEST(!claim->is_lost());
  BOOST_TEST(Claim::take(run) == nullptr);
  claim.reset();
  BOOST_TEST(Claim::take(run) != nullptr);
}

BOOST_FIXTURE_TEST_CASE(of_many_that_claim_at_once_one_succeeds, RunFolder) {
  constexpr int n_runs = 50, n_workers = 4;
  const fs::path runs = run.parent_path();
  std::vector<pid_t> workers;
  for (int w = 0; w < n_workers; ++w) {
    workers.push_back(waiting_process([&] {
      std::vector<std::unique_ptr<Claim>> claims;
      for (int i = 0; i < n_runs; ++i) {
        const fs::path place = runs / ("run" + std::to_string(i));
        claims.push_back(Claim::take(place));
        if (claims.back()) write_text(place / ("won_by_" + std::to_string(w)), "");
      }
      return claims;
    }));
  }
  const auto wins = [&] {
    int count = 0;
    for (int i = 0; i < n_runs; ++i) {
      for (int w = 0; w < n_workers; ++w) {
        count += fs::exists(runs / ("run" + std::to_string(i)) / ("won_by_" + std::to_string(w))) ? 1 : 0;
      }
    }
    return count;
  };
  BOOST_TEST(comes_true([&] { return wins() >= n_runs; }, std::chrono::seconds(60)));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  BOOST_TEST(wins() == n_runs);
  for (const pid_t worker : workers) end_process(worker);
}

BOOST_FIXTURE_TEST_CASE(the_claim_of_a_process_that_has_ended_is_free_at_once, RunFolder) {
  const pid_t process = waiting_process([&] { return Claim::take(run); });
  BOOST_TEST(comes_true([&] { return fs::exists(run / "claim.1"); }, std::chrono::seconds(60)));
  // The age of its claim does not matter.
  age_claim(1, 100000);
  BOOST_TEST(Claim::take(run) == nullptr);
  end_process(process);
  age_claim(1, 0);
  BOOST_TEST(Claim::take(run) != nullptr);
  BOOST_TEST(fs::exists(run / "claim.2"));
}

BOOST_FIXTURE_TEST_CASE(on_another_machine_the_time_of_the_claim_decides, RunFolder) {
  claim_elsewhere(1);
  BOOST_TEST(Claim::take(run) == nullptr);
  age_claim(1, 290);
  BOOST_TEST(Claim::take(run) == nullptr);
  age_claim(1, 310);
  BOOST_TEST(Claim::take(run) != nullptr);
  // Only the last claim counts, whatever the age of those before it.
  claim_elsewhere(3);
  BOOST_TEST(Claim::take(run) == nullptr);
}

BOOST_FIXTURE_TEST_CASE(released_claims_are_taken_at_once, RunFolder) {
  BOOST_TEST(Claim::take(run) != nullptr);
  BOOST_TEST((age_of_claim(1) > std::chrono::seconds(1000)));
}

BOOST_FIXTURE_TEST_CASE(a_worker_notices_that_another_one_has_its_run, RunFolder) {
  vehd::Interruption interruption;
  const auto claim = Claim::take(run, std::chrono::milliseconds(10));
  BOOST_TEST_REQUIRE(claim != nullptr);
  age_claim(1, 1000);
  BOOST_TEST(comes_true([&] { return age_of_claim(1) < std::chrono::seconds(500); }, std::chrono::seconds(60)));
  BOOST_TEST(!claim->is_lost());
  BOOST_TEST(!interruption.requested());
  claim_elsewhere(2);
  BOOST_TEST(comes_true([&] { return interruption.requested(); }, std::chrono::seconds(60)));
  BOOST_TEST(claim->is_lost());
}

BOOST_AUTO_TEST_SUITE_END()
