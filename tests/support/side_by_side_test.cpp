#include "bie/support/side_by_side.hpp"

#include <algorithm>
#include <atomic>
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bie/support/thread_count.hpp"

BOOST_AUTO_TEST_SUITE(side_by_side)

BOOST_AUTO_TEST_CASE(every_task_is_done_once_and_counted) {
  for (const int threads : {1, 2, 3, 5}) {
    const vehd::ThreadCount count(threads);
    for (const vehd::Index n : {0, 1, 3, 4}) {
      std::vector<char> calls(static_cast<std::size_t>(n));
      vehd::Instruments instruments;
      vehd::for_each_side_by_side(n, true, instruments, [&](vehd::Index i, vehd::Instruments& of_one) {
        ++calls[static_cast<std::size_t>(i)];
        of_one.count_kernel("kernel", 1);
      });
      BOOST_TEST(std::ranges::count(calls, 1) == n);
      if (n > 0) BOOST_TEST(instruments.kernel_evaluations().at("kernel") == static_cast<std::uint64_t>(n));
    }
  }
}

BOOST_AUTO_TEST_CASE(as_many_run_at_once_as_there_are_threads) {
  // Each waits for the other, but only for a limited time.
  const auto meet = [](bool worthwhile) {
    std::atomic<int> arrived = 0, met = 0;
    vehd::Instruments instruments;
    vehd::for_each_side_by_side(2, worthwhile, instruments, [&](vehd::Index, vehd::Instruments&) {
      ++arrived;
      const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(worthwhile ? 20 : 0);
      while (arrived < 2 && std::chrono::steady_clock::now() < last) std::this_thread::yield();
      if (arrived == 2) ++met;
    });
    return met.load();
  };
  const vehd::ThreadCount two(2);
  BOOST_TEST(meet(true) == 2);
  BOOST_TEST(meet(false) == 1);
}

BOOST_AUTO_TEST_CASE(the_first_task_that_throws_is_heard_when_all_have_ended) {
  for (const int threads : {1, 2, 4}) {
    const vehd::ThreadCount count(threads);
    std::vector<char> done(4);
    vehd::Instruments instruments;
    const auto body = [&](vehd::Index i, vehd::Instruments&) {
      done[static_cast<std::size_t>(i)] = 1;
      if (i > 0) throw std::runtime_error(std::to_string(i));
    };
    BOOST_CHECK_EXCEPTION(vehd::for_each_side_by_side(4, true, instruments, body), std::runtime_error,
                          [](const std::runtime_error& error) { return error.what() == std::string("1"); });
    BOOST_TEST(std::ranges::count(done, 1) == 4);
  }
}

BOOST_AUTO_TEST_SUITE_END()
