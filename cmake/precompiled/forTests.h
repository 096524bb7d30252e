#pragma once

#include "cmake/precompiled/precompiled.h"

#include <gtest/gtest.h>
