// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cmake/precompiled/precompiled.h"

#include <gtest/gtest.h>
