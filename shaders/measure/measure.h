#pragma once

#include <functional>
#include <string>
#include <vector>

namespace patina::measure {

/// One method at a choice point, on one subject: what it costs and how far it is off.
struct Row {
    std::string point; ///< choice point
    std::string method;
    std::string subject; ///< what it was measured on: `ior 1.5`, `gold`
    std::string error;   ///< what the errors are of: `albedo`, `reflectance`, `noise`
    double ns = 0.0;     ///< median time of an evaluation, one thread
    double nsLow = 0.0;  ///< quartiles
    double nsHigh = 0.0;
    double mean = 0.0; ///< errors, absolute, over a grid of cell centres
    double largest = 0.0;
    double rms = 0.0;
};

/// Errors over a grid.
class Errors {
public:
    void add(double e);
    void into(Row& row) const;

private:
    double _sum = 0.0, _squares = 0.0, _largest = 0.0;
    int _count = 0;
};

/// Times `evaluate(i)` for i in [0, count): one warm batch, then at least 31 of them, each all of
/// i. Its results are summed so that nothing is left out.
void time(const std::function<double(int)>& batch, int evaluations, Row& row);

/// Rows of one choice point; empty when nothing is measured there.
/// @param timed false leaves out the times, which is quick
std::vector<Row> directionalAlbedo(bool timed);
std::vector<Row> energyCompensation(bool timed);
std::vector<Row> sampling(bool timed);
std::vector<Row> fresnel(bool timed);
std::vector<Row> thinFilm(bool timed);
std::vector<Row> diffuse(bool timed);

/// Rows of all choice points, or of `point` alone.
std::vector<Row> measureMethods(const std::string& point, bool timed);

} // namespace patina::measure
