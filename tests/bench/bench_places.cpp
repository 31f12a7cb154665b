// Place recognition at full size: 1000 keyframes of 1000 features. Release preset only.

#include <benchmark/benchmark.h>

#include "services/slam/lib/place_index.hpp"
#include "services/slam/lib/synthetic_places.hpp"

namespace tsg {
namespace {

constexpr KeyframeId kKeyframes = 1000;
constexpr unsigned kPlaces = 50;  // each seen from twenty keyframes

/// An index of views, many of which show the same, as keyframes of one room do.
struct Walk {
  Walk() : index(2 * kKeyframes) {
    std::mt19937 generator(1);
    for (unsigned seed = 0; seed < kPlaces; ++seed) {
      const Features place = synthetic::place(seed);
      if (seed == 0) asked = synthetic::disguised(place, 0.12, generator);
      for (KeyframeId i = 0; i < kKeyframes / kPlaces; ++i) {
        index.add(seed * (kKeyframes / kPlaces) + i, synthetic::disguised(place, 0.12, generator));
      }
    }
  }
  PlaceIndex index;
  std::shared_ptr<const Features> asked;
};

Walk& walk() {
  static Walk known;
  return known;
}

void query_a_known_place(benchmark::State& state) {
  const Walk& known = walk();
  for (auto _ : state) benchmark::DoNotOptimize(known.index.query(*known.asked, {}, 20));
  state.counters["entries"] = static_cast<double>(known.index.entry_count());
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(query_a_known_place)->Unit(benchmark::kMillisecond);

void query_a_new_place(benchmark::State& state) {
  const Walk& known = walk();
  const Features asked = synthetic::place(kPlaces + 1);
  for (auto _ : state) benchmark::DoNotOptimize(known.index.query(asked, {}, 20));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(query_a_new_place)->Unit(benchmark::kMillisecond);

void add_and_remove(benchmark::State& state) {
  Walk& known = walk();
  for (auto _ : state) {
    known.index.add(kKeyframes, known.asked);
    known.index.remove(kKeyframes);
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(add_and_remove)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace tsg

BENCHMARK_MAIN();
