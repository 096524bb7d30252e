// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// One for each reader of what others write: libFuzzer calls it with bytes that it makes
/// (entry.cpp), and a test with those that were kept (testCorpus.cpp). They return 0, and abort
/// where a promise is broken.
int fuzzFilm(const uint8_t* data, size_t size);
int fuzzIes(const uint8_t* data, size_t size);
int fuzzImage(const uint8_t* data, size_t size);
int fuzzMtlx(const uint8_t* data, size_t size);
int fuzzNetwork(const uint8_t* data, size_t size);
