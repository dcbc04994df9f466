// SPDX-License-Identifier: Apache-2.0
// A material and a search that break every promise of their interfaces, one at a time, as the option "how" says. The
// material is a neo-Hookean solid, and honest below the shear modulus `from`.
#ifdef __x86_64__
#include <xmmintrin.h>
#endif
#include <array>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include "tunica/models/isotropic.hpp"
#include "tunica/plugin.hpp"
#include "tunica/tests/point_test.hpp"

namespace {

using namespace tunica;

struct NeoHooke {
  static constexpr std::size_t parameter_count = 1;
  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    return 0.5 * p[0] * x;
  }
};

ModelFactory honest() {
  return isotropic::first_invariant_factory<NeoHooke>(
      {.type = "hostile", .parameters = {{"mu", "kPa", 10, 0.1, 1000, Scale::log, "Shear modulus.", "none"}}},
      "Neo-Hookean until it misbehaves.", "none");
}

int overflow(int depth) {
  volatile char frame[4096];
  frame[0] = static_cast<char>(depth);
  return depth < 0 ? 0 : overflow(depth + 1) + frame[0];
}

/// Memory that is used and never given back. Without the pointer the compiler would leave it out.
void* volatile last_taken = nullptr;
void take(std::size_t bytes) { last_taken = std::memset(std::malloc(bytes), 1, bytes); }
/// The same without the time that the kernel needs for each small page.
void take_large_pages(std::size_t bytes) {
  void* taken = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ::madvise(taken, bytes, MADV_HUGEPAGE);
  last_taken = std::memset(taken, 1, bytes);
}

/// A process that keeps every pipe open, for a minute at most.
void leave_a_process() {
  if (::fork() != 0) return;
  ::alarm(60);
  for (;;) ::pause();
}
void hang() {
  for (;;) ::pause();
}
void fall() { ::raise(SIGSEGV); }
int* volatile no_place = nullptr;
void write_nowhere() { *no_place = 1; }

/// Every file of the program but the standard ones: closed, or made another one.
void spoil_files(bool redirect) {
  const int nowhere = redirect ? ::open("/dev/null", O_RDWR) : -1;
  for (int descriptor = 3; descriptor < 256; ++descriptor) {
    if (!redirect) ::close(descriptor);
    if (redirect && descriptor != nowhere && ::fcntl(descriptor, F_GETFD) >= 0) ::dup2(nowhere, descriptor);
  }
}

void set_timers() {
  const itimerval soon{{0, 1000}, {0, 1000}};
  for (const __itimer_which timer : {ITIMER_REAL, ITIMER_VIRTUAL, ITIMER_PROF}) ::setitimer(timer, &soon, nullptr);
}

void limit_files() {
  const rlimit none{100, 100};
  ::setrlimit(RLIMIT_FSIZE, &none);
}

/// A thread of its own ends the process. The call waits, so that it is under way meanwhile.
template <class End>
void end_in_a_thread(const End& end) {
  std::thread(end).detach();
  std::this_thread::sleep_for(std::chrono::seconds(20));
}

/// Junk in memory that this process shares with another; any code can find this memory.
void spoil_shared_memory() {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    unsigned long begin = 0, end = 0;
    char access[5] = {};
    if (std::sscanf(line.c_str(), "%lx-%lx %4s", &begin, &end, access) != 3 || access[3] != 's') continue;
    if (line.find("/dev/zero") == std::string::npos) continue;
    std::memset(reinterpret_cast<void*>(begin), 0x2f, end - begin);  // NOLINT: "////"
  }
}

/// Once in every process.
void leave_behind(const std::string& how) {
  static std::once_flag left;
  std::call_once(left, [&how] {
    if (how == "leaves_a_process") leave_a_process();
    if (how == "forks") static_cast<void>(::fork());  // and both come back
    if (how == "closes_files") spoil_files(false);
    if (how == "redirects_files") spoil_files(true);
    if (how == "sets_timers") set_timers();
    if (how == "limits_files") limit_files();
    if (how == "thread_falls") end_in_a_thread(write_nowhere);
    if (how == "thread_throws") end_in_a_thread([] { throw std::runtime_error("a bad day"); });
    if (how == "thread_exits") end_in_a_thread([] { std::exit(0); });
    if (how == "thread_exits_at_once") end_in_a_thread([] { ::_exit(0); });
    if (how == "spoils_shared_memory") spoil_shared_memory();
    if (how == "hangs_at_exit") static_cast<void>(std::atexit(hang));
    if (how == "falls_at_exit") static_cast<void>(std::atexit(fall));
  });
}

void misbehave(const std::string& how) {
  leave_behind(how);
  if (how == "throws") throw std::runtime_error("a bad day");
  if (how == "throws_42") throw 42;
  if (how == "prints") std::printf("plugins may not print\n"), std::fflush(stdout);
  if (how == "rounds_up") std::fesetround(FE_UPWARD);
  if (how == "traps") ::feenableexcept(FE_INEXACT | FE_DIVBYZERO);
#ifdef __x86_64__
  if (how == "flushes_to_zero") _mm_setcsr(_mm_getcsr() | 0x8040U);
  if (how == "cuts_precision") {
    const unsigned short word = 0x027f;  // 53 bits
    __asm__ volatile("fldcw %0" : : "m"(word));
  }
#endif
  if (how == "exits") std::exit(0);
  if (how == "exits_at_once") ::_exit(0);
  if (how == "aborts") std::abort();
  if (how == "segfaults") ::raise(SIGSEGV);
  if (how == "overflows_the_stack") overflow(0);
  if (how == "leaks") take(100'000);
  if (how == "allocates_without_end")
    for (;;) take_large_pages(std::size_t{1} << 23);
  if (how == "is_slow") std::this_thread::sleep_for(std::chrono::milliseconds(10));
  if (how == "loops")
    for (;;) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

class HostileModel final : public Model {
 public:
  explicit HostileModel(const Options& options)
      : honest_(honest().create({})), how_(options.text("how")), from_(options.number("from")) {
    if (how_ == "create_loops") hang();
  }
  HostileModel(const HostileModel&) = delete;
  HostileModel& operator=(const HostileModel&) = delete;
  ~HostileModel() override {
    if (how_ == "destructor_falls") fall();
  }
  [[nodiscard]] const ModelDescription& describe() const override {
    if (how_ == "describe_throws") throw 42;
    return honest_->describe();
  }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    return act(points.parameters[0], !response.tangent.empty(), response.stress,
               [&] { return honest_->evaluate(points, response); });
  }
  Status evaluate_axes(const AxisPoints& points, const AxisResponse& response) const override {
    return act(points.parameters[0], !response.hessian.empty(), response.gradient,
               [&] { return honest_->evaluate_axes(points, response); });
  }

 private:
  template <class Honest>
  Status act(double mu, bool tangent, std::span<double> wanted, const Honest& answer) const {
    if (mu < from_) return answer();
    if (how_ == "tires") return tired(wanted, answer());
    if (how_ == "writes_nothing") return {};
    if (how_ == "writes_beyond") wanted.end()[0] = 1;
    if (how_ == "tangent_throws" && tangent) throw std::runtime_error("no tangent today");
    if (how_ == "tangent_throws_42" && tangent) throw 42;
    misbehave(how_);
    return answer();
  }

  /// Half of what is right, from the hundredth call of the process on.
  static Status tired(std::span<double> wanted, Status status) {
    static std::atomic<int> calls = 0;
    if (++calls > 100)
      for (double& value : wanted) value /= 2;
    return status;
  }

  std::unique_ptr<Model> honest_;
  std::string how_;
  double from_;
};

/// Evaluates a few points, then misbehaves.
class HostileSearch final : public Optimizer {
 public:
  explicit HostileSearch(const Options& options) : how_(options.text("how")) {}
  HostileSearch(const HostileSearch&) = delete;
  HostileSearch& operator=(const HostileSearch&) = delete;
  ~HostileSearch() override {
    if (how_ == "destructor_falls") fall();
    if (how_ == "destructor_hangs") hang();
  }
  [[nodiscard]] const Needs& needs() const override {
    if (how_ == "needs_throw") throw 42;
    return needs_;
  }
  Outcome minimise(Problem& problem) override {
    double objective = 0;
    for (double x : {0.2, 0.3, 0.4})
      static_cast<void>(problem.evaluate(std::vector<double>(problem.dimension(), x), objective));
    misbehave(how_);
    return {true, "three points are enough"};
  }

 private:
  Needs needs_;
  std::string how_;
};

/// A strip along its axis of an incompressible material, σ = λ² S_z − S_r/λ.
struct Strip {
  static constexpr auto type = "hostile_strip", doc = "A strip until it misbehaves.", reference = "none",
                        admitted = "a stretch above 0";
  static constexpr std::array<Quantity, 0> diagnostics{};
  explicit Strip(const TestSetup&) {}
  static std::vector<Option> options() { return {Option::text("how", "honest", "What it does wrong.")}; }
  static std::vector<Observable> observables() {
    return {{"stretch", "1", Observable::Role::abscissa, true, "Stretch."},
            {"stress", "kPa", Observable::Role::channel, true, "Cauchy stress."}};
  }
  bool admits(double stretch) const { return stretch > 0; }
  double diagnostic(std::size_t, double) const { return 0; }
  template <class T>
  std::array<T, 6> deformation(const T& stretch) const {
    return {1.0 / stretch, stretch * stretch, 1.0 / stretch, T(0), T(0), T(0)};
  }
  template <class T>
  T channel(std::size_t, const T& stretch, const std::array<T, 6>& S) const {
    return stretch * stretch * S[1] - S[2] / stretch;
  }
};

/// Says ok and writes nothing, or no derivatives.
class HostileTest final : public Test {
 public:
  HostileTest(std::unique_ptr<Test> honest, std::string how) : honest_(std::move(honest)), how_(std::move(how)) {}
  [[nodiscard]] const TestDescription& describe() const override { return honest_->describe(); }
  [[nodiscard]] const TestRows& rows() const override { return honest_->rows(); }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    if (how_ == "writes_nothing") return {};
    if (how_ == "writes_no_derivatives") return honest_->predict(input, {output.values, {}, {}, {}});
    misbehave(how_);
    return honest_->predict(input, output);
  }

 private:
  std::unique_ptr<Test> honest_;
  std::string how_;
};

}  // namespace

TUNICA_PLUGIN("hostile", "1.0.0") {
  const char* at_load = std::getenv("HOSTILE_AT_LOAD");
  if (at_load != nullptr) misbehave(at_load);
  ModelFactory model = honest();
  model.options = {Option::text("how", "honest", "What it does wrong."),
                   Option::number("from", 0, {0, 1e9}, "The shear modulus from which on it does so, in kPa.")};
  model.create = [](const Options& options) { return std::make_unique<HostileModel>(options); };
  registry.add(std::move(model));
  registry.add(
      OptimizerFactory{.type = "hostile_search",
                       .doc = "Three points, and then misbehaviour.",
                       .reference = "none",
                       .options = {Option::text("how", "honest", "What it does wrong.")},
                       .create = [](const Options& options) { return std::make_unique<HostileSearch>(options); }});
  TestFactory test = point_test_factory<Strip>();
  test.create = [create = test.create](const TestSetup& setup) {
    return std::make_unique<HostileTest>(create(setup), setup.options.text("how"));
  };
  registry.add(std::move(test));
}
