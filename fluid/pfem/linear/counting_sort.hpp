// Items by small integer keys, those of one key in the order in which they came: a counting sort on all threads, O(items +
// keys), the same for any number of threads.
#pragma once

#include <vector>

#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {

/// `each(source, put)`: calls put(key, item) for the items of a source, alike whenever it is called; 0 <= source < sources,
/// 0 <= key < keys. Items of key k go to [start[k], start[k + 1]) of an array that `room(count)` makes and
/// `place(where, item)` fills.
template <class Each, class Room, class Place>
void counting_sort(std::size_t sources, std::size_t keys, std::vector<int>& start, Each each, Room room, Place place) {
  // Each block of sources counts for itself: as many as threads, for each takes a pass over the keys.
  constexpr std::size_t few = 10000;  // sources
  const std::size_t blocks = sources < few ? 1 : static_cast<std::size_t>(threads());
  std::vector<int> next(blocks * keys, 0);
  auto in_blocks = [&](auto visit) {
    in_pieces(blocks, 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t b = from; b < to; ++b)
        for (std::size_t s = sources * b / blocks; s < sources * (b + 1) / blocks; ++s)
          visit(s, next.data() + b * keys);
    });
  };
  in_blocks([&](std::size_t s, int* count) { each(s, [&](int key, const auto&) { ++count[key]; }); });
  start.resize(keys + 1);
  int before = 0;
  for (std::size_t k = 0; k < keys; ++k) {
    start[k] = before;
    for (std::size_t b = 0; b < blocks; ++b) {
      const int count = next[b * keys + k];
      next[b * keys + k] = before;
      before += count;
    }
  }
  start[keys] = before;
  room(static_cast<std::size_t>(before));
  in_blocks([&](std::size_t s, int* to) { each(s, [&](int key, const auto& item) { place(to[key]++, item); }); });
}

}  // namespace splashdown::fluid
