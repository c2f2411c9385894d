// Fewer points of a curve, so that a page can hold it.
#pragma once

#include <vector>

namespace splashdown::apps {

/// At most about `limit` points that keep every extreme the eye could see: the lowest and the highest point of each of limit/2 groups.
void thin(std::vector<double>& x, std::vector<double>& y, std::size_t limit);

/// Without points that stand less than `tolerance` above or below the straight line between those that stay; the lowest and the
/// highest point stay, and so do gaps (nan). One pass that holds a cone of slopes from the point before (swinging door, Bristol 1990).
void straighten(std::vector<double>& x, std::vector<double>& y, double tolerance);

}  // namespace splashdown::apps
