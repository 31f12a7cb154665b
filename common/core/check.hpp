#pragma once

#include <cstdio>
#include <cstdlib>

/// Aborts on a broken invariant, i.e. on a bug of ours; never used on input. systemd restarts.
#define TSG_CHECK(condition)                                                                 \
  do {                                                                                       \
    if (!(condition)) {                                                                      \
      std::fprintf(stderr, "%s:%d: broken invariant: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                          \
    }                                                                                        \
  } while (false)
