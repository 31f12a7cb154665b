#pragma once

namespace tsg {

/// Where a topic lives (docs/architecture.md): fixed-size camera data of this host, handed over
/// through shared memory, or standard DDS for everybody.
enum class Domain { kStandard, kSharedMemory };

enum class Durability {
  kVolatile,
  kTransientLocal,  ///< latched: who subscribes later gets the last sample
};

/// What a topic promises; always reliable. Shared memory takes volatile topics only.
struct Qos {
  Domain domain = Domain::kStandard;
  Durability durability = Durability::kVolatile;
  int keep_last = 10;  ///< samples a slow reader may fall behind before the oldest is dropped
};

}  // namespace tsg
