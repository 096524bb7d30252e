// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// One for each reader of what others write: libFuzzer calls it with bytes that it makes
/// (entry.cpp), and a test with those that were kept (testCorpus.cpp). They abort where a promise
/// is broken.
/// @returns whether the reader took the bytes, so that a test tells inputs that it refuses at once
bool fuzzFilm(const uint8_t* data, size_t size);
bool fuzzIes(const uint8_t* data, size_t size);
bool fuzzImage(const uint8_t* data, size_t size);
bool fuzzMtlx(const uint8_t* data, size_t size);
bool fuzzMtlxIncludes(const uint8_t* data, size_t size);
bool fuzzNetwork(const uint8_t* data, size_t size);
bool fuzzParts(const uint8_t* data, size_t size);
bool fuzzTexture(const uint8_t* data, size_t size);
