// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <type_traits>

/// Vector units of the machine, chosen at run time inside one library.
///
/// A kernel is a callable, without arguments or with the lanes of the level as a constant. `vectorised()` runs a copy
/// of it that is compiled for the instructions of the level, with everything inlined that it calls:
///
///     detail::vectorised([&] {
///       for (std::size_t i = 0; i < n; ++i) y[i] = a * x[i] + y[i];
///     });
///
/// Only those copies contain such instructions. They have names of their own, so the linker never takes one of them for
/// the ordinary code of an inline function. No compiler flag changes, and no type that crosses a plugin's boundary.
///
/// Results: within a level every evaluation gives the same bits. Levels differ in rounding, by fused multiplication and
/// addition and by the vector functions of libmvec: energies by 1e-13 relative, free strips by 2e-12, curves of finite
/// elements by 1e-13 and their derivatives by 1e-11.
///
/// Pad loops over lanes if a value must not depend on its position: the compiler finishes a loop of odd length with
/// scalar functions.
///
/// Threads: everything here is thread-safe.
///
/// TUNICA_LANES stands before a loop over lanes, and says that no lane reads what another one writes, whatever the
/// pointers.
#if defined(__clang__)
#define TUNICA_LANES _Pragma("clang loop vectorize(assume_safety)")
#define TUNICA_FOR_KERNELS [[gnu::flatten]]
#else
#define TUNICA_LANES _Pragma("GCC ivdep")
/// On a function that calls a formula of an author's: the formula comes with it into a kernel. What the compiler has
/// specialised instead, `flatten` would leave outside, with the instructions of the baseline.
#define TUNICA_FOR_KERNELS [[gnu::flatten, gnu::noclone]]
#endif

namespace tunica::detail {

/// Sets of instructions, each one a superset of those before.
enum class VectorLevel {
  baseline,  ///< what every x86-64 has (SSE2), or another architecture
  avx2,      ///< AVX2 and FMA
  avx512     ///< AVX-512 F, DQ, VL
};
inline constexpr std::array<const char*, 3> vector_level_names{"baseline", "avx2", "avx512"};
/// As TUNICA_VECTOR_LEVEL and result.json spell it.
inline constexpr const char* name(VectorLevel level) { return vector_level_names[static_cast<std::size_t>(level)]; }
/// The level of that name.
inline constexpr std::optional<VectorLevel> vector_level_called(std::string_view text) {
  for (std::size_t i = 0; i < vector_level_names.size(); ++i)
    if (text == vector_level_names[i]) return static_cast<VectorLevel>(i);
  return {};
}

/// The environment variable that limits the level.
inline constexpr const char* vector_level_variable = "TUNICA_VECTOR_LEVEL";
/// Lanes of a double at the widest level. Rows of scratch memory are multiples of it.
inline constexpr std::size_t widest = 8;

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define TUNICA_VECTOR_LEVELS_ 1
#endif

/// Lanes of a double in a vector of the level; 2 where the compiler is left to itself.
inline constexpr std::size_t lanes_of(VectorLevel level) {
  return level == VectorLevel::avx512 ? 8 : level == VectorLevel::avx2 ? 4 : 2;
}

/// The highest level that this processor, the system and this build offer.
inline VectorLevel best_vector_level() {
#ifdef TUNICA_VECTOR_LEVELS_
  __builtin_cpu_init();
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return VectorLevel::baseline;
  const bool wide =
      __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  return wide ? VectorLevel::avx512 : VectorLevel::avx2;
#else
  return VectorLevel::baseline;
#endif
}

/// The level of this library: −1 until it is first asked for.
inline constinit std::atomic<int> chosen_vector_level = -1;

/// Sets the level of this library from now on, for tests and benchmarks. A level above the processor's best
/// one becomes that one.
inline void use_vector_level(VectorLevel level) {
  const VectorLevel best = best_vector_level();
  chosen_vector_level.store(static_cast<int>(level < best ? level : best), std::memory_order_relaxed);
}

/// The level as TUNICA_VECTOR_LEVEL states it, else the best. The host refuses values that are no level, or more than
/// the processor has, before any plugin is loaded; here they count as not stated.
inline VectorLevel vector_level() {
  int level = chosen_vector_level.load(std::memory_order_relaxed);
  if (level < 0) [[unlikely]] {
    const char* const stated = std::getenv(vector_level_variable);
    use_vector_level((stated != nullptr ? vector_level_called(stated) : std::nullopt).value_or(VectorLevel::avx512));
    level = chosen_vector_level.load(std::memory_order_relaxed);
  }
  return static_cast<VectorLevel>(level);
}

/// The lanes of a level, as a constant.
template <VectorLevel level>
using LaneCount = std::integral_constant<std::size_t, lanes_of(level)>;

/// The kernel itself; one with an argument gets the level's LaneCount.
template <VectorLevel level, class Kernel>
[[gnu::always_inline]] inline void run(const Kernel& kernel) {
  if constexpr (std::is_invocable_v<const Kernel&, LaneCount<level>>)
    kernel(LaneCount<level>());
  else
    kernel();
}

template <class Kernel>
[[gnu::flatten, gnu::noinline]] void run_on_baseline(const Kernel& kernel) {
  run<VectorLevel::baseline>(kernel);
}
#ifdef TUNICA_VECTOR_LEVELS_
template <class Kernel>
[[gnu::target("avx2,fma"), gnu::flatten, gnu::noinline]] void run_on_avx2(const Kernel& kernel) {
  run<VectorLevel::avx2>(kernel);
}
template <class Kernel>
[[gnu::target("avx2,fma,avx512f,avx512dq,avx512vl,prefer-vector-width=512"), gnu::flatten, gnu::noinline]] void
run_on_avx512(const Kernel& kernel) {
  run<VectorLevel::avx512>(kernel);
}
#endif

/// Runs a part of a kernel as a separate function, with the instructions of the level with this many lanes. Compilers
/// optimise code inside a large kernel less well than the same code alone.
template <std::size_t width, class Kernel>
[[gnu::always_inline]] inline void apart(const Kernel& kernel) {
#ifdef TUNICA_VECTOR_LEVELS_
  if constexpr (width == lanes_of(VectorLevel::avx512))
    return run_on_avx512(kernel);
  else if constexpr (width == lanes_of(VectorLevel::avx2))
    return run_on_avx2(kernel);
  else
#endif
    run_on_baseline(kernel);
}

/// Runs the kernel on the level of this library.
template <class Kernel>
inline void vectorised(const Kernel& kernel) {
#ifdef TUNICA_VECTOR_LEVELS_
  switch (vector_level()) {
    case VectorLevel::avx512:
      return run_on_avx512(kernel);
    case VectorLevel::avx2:
      return run_on_avx2(kernel);
    case VectorLevel::baseline:
      break;
  }
#endif
  run<VectorLevel::baseline>(kernel);
}

}  // namespace tunica::detail
