#include "result/compare.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "result/summary.hpp"

namespace railstrata {
namespace {

bool grows(const std::vector<double>& t) {
  return t.size() >= 2 && std::adjacent_find(t.begin(), t.end(), std::greater_equal<>()) == t.end();
}

/// A field's points as the product of two lines.
class Lattice {
 public:
  explicit Lattice(const ContactField& f) {
    for (int s = 0; s < f.stations; ++s) x_.push_back(f.x[static_cast<std::size_t>(s) * f.columns]);
    for (int c = 0; c < f.columns; ++c) y_.push_back(f.y[c]);
    if (!grows(x_) || !grows(y_))
      throw std::invalid_argument("compare_fields: x must grow with the station and y with the column");
  }
  const std::vector<double>& x() const { return x_; }
  const std::vector<double>& y() const { return y_; }

  /// value(index) interpolated; zero outside.
  template <class Value>
  double at(double x, double y, Value&& value) const {
    const Place i = place(x_, x), j = place(y_, y);
    if (!i.inside || !j.inside) return 0;
    const std::size_t k = i.first * y_.size() + j.first, next = k + y_.size();
    return (1 - i.t) * ((1 - j.t) * value(k) + j.t * value(k + 1)) +
           i.t * ((1 - j.t) * value(next) + j.t * value(next + 1));
  }

 private:
  struct Place {
    std::size_t first;
    double t;
    bool inside;
  };
  static Place place(const std::vector<double>& line, double at) {
    if (at < line.front() || at > line.back()) return {0, 0, false};
    const auto above = std::min(std::upper_bound(line.begin() + 1, line.end(), at), line.end() - 1);
    const auto k = static_cast<std::size_t>(above - line.begin()) - 1;
    return {k, (at - line[k]) / (line[k + 1] - line[k]), true};
  }
  std::vector<double> x_, y_;
};

struct Range {
  double low = 1e300, high = -1e300;
  void add(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
};

double finest(const std::vector<double>& t) {
  double h = t[1] - t[0];
  for (std::size_t i = 1; i < t.size(); ++i) h = std::min(h, t[i] - t[i - 1]);
  return h;
}

/// Points over the range and the coarser line's spacing on either side, falling on those of the finer line where it is
/// even.
std::vector<double> line_over(const Range& r, const std::vector<double>& a, const std::vector<double>& b) {
  const double ha = finest(a), hb = finest(b), margin = std::max(ha, hb);
  const double origin = ha <= hb ? a.front() : b.front(), fine = std::min(ha, hb);
  const double step = fine * std::ceil((r.high - r.low + 2 * margin) / (fine * (kMostPoints - 2)));
  const double tiny = 1e-6;
  const auto first = static_cast<long>(std::floor((r.low - margin - origin) / step + tiny)),
             last = static_cast<long>(std::ceil((r.high + margin - origin) / step - tiny));
  std::vector<double> out;
  for (long k = first; k <= last; ++k) out.push_back(origin + static_cast<double>(k) * step);
  return out;
}

FieldDifference difference(const FieldComparison& g, const std::vector<double>& a, const std::vector<double>& b) {
  FieldDifference d;
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (!(g.p_a[k] > 0 || g.p_b[k] > 0)) continue;
    const double e = a[k] - b[k];
    sum += e * e;
    count += 1;
    if (std::abs(e) > d.largest) d = {std::abs(e), g.x[k / g.y.size()], g.y[k % g.y.size()], 0};
  }
  const double scale = *std::max_element(b.begin(), b.end());
  d.rms = scale > 0 ? std::sqrt(sum / count) / scale : kNotApplicable;
  d.largest = scale > 0 ? d.largest / scale : kNotApplicable;
  return d;
}

}  // namespace

FieldComparison compare_fields(const ContactField& a, const ContactField& b) {
  const Lattice la(a), lb(b);
  Range x, y;
  for (const ContactField* f : {&a, &b})
    for (std::size_t k = 0; k < f->p.size(); ++k)
      if (f->p[k] > 0) {
        x.add(f->x[k]);
        y.add(f->y[k]);
      }
  if (x.low > x.high) throw std::invalid_argument("compare_fields: no pressure in either field");

  FieldComparison g;
  g.x = line_over(x, la.x(), lb.x());
  g.y = line_over(y, la.y(), lb.y());
  const auto sample = [&](const Lattice& l, const ContactField& f, std::vector<double>& p, std::vector<double>& q) {
    for (double gx : g.x)
      for (double gy : g.y) {
        p.push_back(l.at(gx, gy, [&](std::size_t k) { return f.p[k]; }));
        q.push_back(std::hypot(l.at(gx, gy, [&](std::size_t k) { return f.q_x[k]; }),
                               l.at(gx, gy, [&](std::size_t k) { return f.q_y[k]; })));
      }
  };
  sample(la, a, g.p_a, g.q_a);
  sample(lb, b, g.p_b, g.q_b);
  g.p = difference(g, g.p_a, g.p_b);
  g.q = difference(g, g.q_a, g.q_b);
  return g;
}

}  // namespace railstrata
