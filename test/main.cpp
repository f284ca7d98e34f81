// SPDX-License-Identifier: MIT
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <csignal>
#include <cstdlib>
#include <unistd.h>

namespace {

/// Ends the tests if a test case takes more than ten minutes. Otherwise a test case that waits for
/// ever would stop all of CI, and nobody would learn its name: doctest prints it after abort().
class Watchdog : public doctest::IReporter {
  public:
    explicit Watchdog(const doctest::ContextOptions&) {}
    void test_run_start() override {
        std::signal(SIGALRM, [](int) {
            constexpr char text[] = "this test case has taken more than ten minutes:\n";
            [[maybe_unused]] const auto written = write(STDERR_FILENO, text, sizeof text - 1);
            std::abort();
        });
    }
    void test_case_start(const doctest::TestCaseData&) override { alarm(600); }
    void test_case_end(const doctest::CurrentTestCaseStats&) override { alarm(0); }

    void report_query(const doctest::QueryData&) override {}
    void test_run_end(const doctest::TestRunStats&) override {}
    void test_case_reenter(const doctest::TestCaseData&) override {}
    void test_case_exception(const doctest::TestCaseException&) override {}
    void subcase_start(const doctest::SubcaseSignature&) override {}
    void subcase_end() override {}
    void log_assert(const doctest::AssertData&) override {}
    void log_message(const doctest::MessageData&) override {}
    void test_case_skipped(const doctest::TestCaseData&) override {}
};
REGISTER_LISTENER("watchdog", 1, Watchdog);

}  // namespace
