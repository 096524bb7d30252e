// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/plan/methodTable.h"

#include <algorithm>
#include <cmath>

namespace patina {

MethodFigures methodFigures(const std::string& point, const std::string& method) {
    MethodFigures f;
    double logCost = 0.0;
    int count = 0;
    for (const MeasuredMethod& row : methodTable()) {
        if (point != row.point || method != row.method) continue;
        f.measured = true;
        f.errorOf = row.errorOf;
        f.mean = std::max(f.mean, row.mean);
        f.largest = std::max(f.largest, row.largest);
        logCost += std::log(double(row.cost));
        ++count;
    }
    if (count > 0) f.cost = float(std::exp(logCost / count));
    return f;
}

} // namespace patina
