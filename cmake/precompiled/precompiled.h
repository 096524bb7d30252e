// SPDX-License-Identifier: Apache-2.0
#pragma once

// Headers of other projects that most files include, compiled once. Every file still includes what
// it uses: with -DPATINA_PRECOMPILED=OFF nothing of this is there.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>
