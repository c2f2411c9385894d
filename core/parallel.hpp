// Loops whose turns do not depend on each other: the same result for any number of threads. (TBB: OpenMP's threads spin
// while they wait, and a busy machine stands still.)
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#ifdef __SANITIZE_THREAD__
#include <atomic>
#include <thread>
#endif

namespace splashdown {

/// Threads that loops run on from here on; 0: all cores.
void use_threads(int count);
int threads();  ///< that loops run on

/// A value for each thread that asks for its own with local(), made by what it is given.
template <class Value>
using PerThread = tbb::enumerable_thread_specific<Value>;

#ifdef __SANITIZE_THREAD__
// The thread sanitizer does not
// a race. Under it threads of the standard library do the same pieces.
template <class Visit>
void shared_pieces(std::size_t count, std::size_t grain, Visit visit) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t first; (first = next.fetch_add(grain, std::memory_order_relaxed)) < count;)  // orders nothing else
      visit(first, std::min(first + grain, count));
  };
  std::vector<std::thread> others;
  for (int k = 1; k < threads(); ++k) others.emplace_back(work);
  work();
  for (auto& other : others) other.join();
}
#else
/// visit(first, last) for pieces of [0, count) of about `grain`, on the threads of TBB.
template <class Visit>
void shared_pieces(std::size_t count, std::size_t grain, Visit visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& piece) { visit(piece.begin(), piece.end()); });
}
#endif

/// visit(first, last) for pieces of [0, count) of at least `grain`.
template <class Visit>
void in_pieces(std::size_t count, std::size_t grain, Visit visit) {
  if (count <= grain) {
    visit(std::size_t{0}, count);
    return;
  }
  shared_pieces(count, grain, visit);
}

/// Turns of a short loop: for less, waking a thread costs more than it saves.
inline constexpr std::size_t worthwhile = 1000;

/// visit(i) for 0 <= i < count.
template <class Visit>
void in_parallel(std::size_t count, Visit visit) {
  in_pieces(count, worthwhile, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) visit(i);
  });
}

/// The sum of value(i) for 0 <= i < count, in pieces that do not depend on the number of threads.
template <class Value>
double sum_in_parallel(std::size_t count, Value value) {
  std::vector<double> pieces((count + worthwhile - 1) / worthwhile, 0.0);
  in_pieces(pieces.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p)
      for (std::size_t i = p * worthwhile; i < std::min(count, (p + 1) * worthwhile); ++i) pieces[p] += value(i);
  });
  return std::accumulate(pieces.begin(), pieces.end(), 0.0);
}

/// The least value(i) for 0 <= i < count, infinity for none.
template <class Value>
double least_in_parallel(std::size_t count, Value value) {
#ifdef __SANITIZE_THREAD__
  std::vector<double> values(count + 1, std::numeric_limits<double>::infinity());
  in_parallel(count, [&](std::size_t i) { values[i] = value(i); });
  return *std::min_element(values.begin(), values.end());
#else
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, count, worthwhile), std::numeric_limits<double>::infinity(),
      [&](const tbb::blocked_range<std::size_t>& piece, double least) {
        for (std::size_t i = piece.begin(); i < piece.end(); ++i) least = std::min(least, value(i));
        return least;
      },
      [](double a, double b) { return std::min(a, b); });
#endif
}

}  // namespace splashdown
