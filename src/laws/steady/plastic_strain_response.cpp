#include "steady/plastic_strain_response.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/parallel.hpp"
#include "fft/fft.hpp"

namespace railstrata {

namespace {

using Complex = std::complex<double>;

struct Mat2 {
  double a = 0, b = 0, c = 0, d = 0;  // rows (a b), (c d)
};
Mat2 operator*(Mat2 l, Mat2 r) {
  return {l.a * r.a + l.b * r.c, l.a * r.b + l.b * r.d, l.c * r.a + l.d * r.c, l.c * r.b + l.d * r.d};
}
Mat2 operator+(Mat2 l, Mat2 r) { return {l.a + r.a, l.b + r.b, l.c + r.c, l.d + r.d}; }
Mat2 operator-(Mat2 l, Mat2 r) { return {l.a - r.a, l.b - r.b, l.c - r.c, l.d - r.d}; }
Mat2 scaled(double f, Mat2 m) { return {f * m.a, f * m.b, f * m.c, f * m.d}; }
Mat2 transposed(Mat2 m) { return {m.a, m.c, m.b, m.d}; }
Mat2 inverse(Mat2 m) {
  const double det = m.a * m.d - m.b * m.c;
  return {m.d / det, -m.b / det, -m.c / det, m.a / det};
}

/// Stiffness of a row, blocks of its upper and lower node: of (u_n, u_z / i) and of u_m.
struct RowStiffness {
  Mat2 upper, across, lower;  // across: upper row, lower column
  double m_same = 0, m_across = 0;
};

/// Strains per mean (1/2 each node) and per difference (∓1/h): e_nn/i = k a, e_zz/i = b', 2 e_nz = a' - k b.
RowStiffness row_stiffness(RowModuli m, double h, double k) {
  const double p = m.lambda + 2 * m.mu, half = 0.5 * k, d = 1 / h;
  const auto block = [&](double s, double t) {  // s, t: -d of an upper node, +d of a lower one
    return Mat2{h * (p * half * half + m.mu * s * t), h * (m.lambda * half * t - m.mu * s * half),
                h * (m.lambda * s * half - m.mu * half * t), h * (p * s * t + m.mu * half * half)};
  };
  return {block(-d, -d), block(-d, d), block(d, d), h * m.mu * (half * half + d * d), h * m.mu * (half * half - d * d)};
}

}  // namespace

/// Factors of a node: D^-1, and the coupling to the node below, U = A(i, i+1) D(i+1)^-1.
struct PlasticStrainResponse::Wave {
  Mat2 inverse, below;
  double m_inverse = 0, m_below = 0;
};

namespace {

/// 2/h tan(k h/2) of wave number index i of n, signed; NaN: the shortest wave of an even number, infinitely stiff.
double wave_number(int i, int n, double h) {
  const int signed_index = 2 * i > n ? i - n : i;
  if (2 * i == n) return std::nan("");
  return 2 / h * std::tan(std::numbers::pi * signed_index / n);
}

std::vector<double> rows_below(const SteadyGrid& grid) {
  constexpr double kGrowth = 1.2;
  double depth = 0;
  for (const double t : grid.thickness) depth += t;
  const double goal = depth + std::max(grid.nx * grid.dx, grid.ny > 1 ? grid.ny * grid.dy : 0.0);
  std::vector<double> below;
  double t = grid.thickness.back();
  while (depth < goal) {
    t *= kGrowth;
    below.push_back(t);
    depth += t;
  }
  return below;
}

/// Displacements u_n, u_z / i, u_m of a node, or forces on it.
using Node = std::array<Complex, 3>;

/// f - m g.
Node less(const Node& f, const Mat2& m, double antiplane, const Node& g) {
  return {f[0] - (m.a * g[0] + m.b * g[1]), f[1] - (m.c * g[0] + m.d * g[1]), f[2] - antiplane * g[2]};
}

/// One pair of wave numbers of all planes of a field.
struct Spectrum {
  Complex* first;
  std::size_t plane;
  int rows;
  Complex& operator()(int component, int row) const {
    return first[(static_cast<std::size_t>(component) * static_cast<std::size_t>(rows) +
                  static_cast<std::size_t>(row)) *
                 plane];
  }
};

/// i z and z / i: a product of complex numbers would look for infinities in each.
Complex times_i(Complex z) { return {-z.imag(), z.real()}; }
Complex over_i(Complex z) { return {z.imag(), -z.real()}; }

struct Direction {
  double k, c, s;  ///< wave number; cosine and sine of the wave's direction
};

/// Forces of a row's plastic strain, 2 mu E^p against the virtual strains of row_stiffness().
void add_load(const Spectrum& plastic, int r, Direction n, double h, double mu, Node& upper, Node& lower) {
  const Complex xx = plastic(0, r), yy = plastic(1, r), xy = plastic(3, r), yz = plastic(4, r), xz = plastic(5, r);
  const double g = 2 * mu, cs = n.c * n.s;
  const Complex nn = g * over_i(n.c * n.c * xx + n.s * n.s * yy + 2 * cs * xy), zz = g * over_i(plastic(2, r));
  const Complex nm = g * over_i(cs * (yy - xx) + (n.c * n.c - n.s * n.s) * xy);
  const Complex nz = g * (n.c * xz + n.s * yz), mz = g * (n.c * yz - n.s * xz);
  const double half = 0.5 * n.k * h;
  const Node same{half * nn, -half * nz, half * nm}, slope{nz, zz, mz};
  for (std::size_t c = 0; c < 3; ++c) {
    upper[c] += same[c] - slope[c];
    lower[c] += same[c] + slope[c];
  }
}

/// The strain of a row between its nodes.
void put_strain(const Node& upper, const Node& lower, Direction n, double h, const Spectrum& strain, int r) {
  const double d = 1 / h, half = 0.5 * n.k, cs = n.c * n.s;
  const Complex nn = half * times_i(upper[0] + lower[0]);
  const Complex nz = 0.5 * (d * (lower[0] - upper[0]) - half * (upper[1] + lower[1]));
  const Complex nm = 0.5 * half * times_i(upper[2] + lower[2]), mz = 0.5 * d * (lower[2] - upper[2]);
  strain(0, r) = n.c * n.c * nn - 2 * cs * nm;
  strain(1, r) = n.s * n.s * nn + 2 * cs * nm;
  strain(2, r) = d * times_i(lower[1] - upper[1]);
  strain(3, r) = cs * nn + (n.c * n.c - n.s * n.s) * nm;
  strain(4, r) = n.s * nz + n.c * mz;
  strain(5, r) = n.c * nz - n.s * mz;
}

/// Displacement of the surface from that of its node.
void put_surface(const Node& top, Direction n, const Spectrum& surface) {
  surface(0, 0) = n.c * top[0] - n.s * top[2];
  surface(1, 0) = n.s * top[0] + n.c * top[2];
  surface(2, 0) = times_i(top[1]);
}

}  // namespace

PlasticStrainResponse::PlasticStrainResponse(SteadyGrid grid, std::vector<RowModuli> rows, RowModuli below)
    : grid_(std::move(grid)),
      moduli_(std::move(rows)),
      below_(below),
      width_(grid_.ny / 2 + 1),
      fft_(std::make_unique<RealPlaneFft>(grid_.nx, grid_.ny)) {
  if (moduli_.size() != grid_.thickness.size() || moduli_.empty())
    throw std::invalid_argument("PlasticStrainResponse: a modulus for every row");
  deep_ = rows_below(grid_);
  factors_.resize(static_cast<std::size_t>(grid_.nx / 2 + 1) * static_cast<std::size_t>(width_) *
                  (grid_.thickness.size() + 1));
  for_each(grid_.nx / 2 + 1, [&](std::ptrdiff_t kx) {
    for (int ky = 0; ky < width_; ++ky) factorize(static_cast<int>(kx), ky);
  });
  const int planes = 6 * grid_.rows() + 3;  // strains, displacements of the surface
  spectrum_.resize(static_cast<std::size_t>(planes) * static_cast<std::size_t>(grid_.nx) *
                   static_cast<std::size_t>(width_));
}

PlasticStrainResponse::~PlasticStrainResponse() = default;

void PlasticStrainResponse::factorize(int kx, int ky) {
  const double x = wave_number(kx, grid_.nx, grid_.dx), y = grid_.ny > 1 ? wave_number(ky, grid_.ny, grid_.dy) : 0;
  const double k = std::hypot(x, y);
  const int rows = grid_.rows();
  Wave* wave = factors_.data() + (static_cast<std::size_t>(kx) * width_ + ky) * static_cast<std::size_t>(rows + 1);
  if (std::isnan(k)) return;
  Mat2 d;
  double m = 0;
  Mat2 under;  // what the rows below a node add to it
  double m_under = 0;
  for (int r = rows + static_cast<int>(deep_.size()) - 1; r >= 0; --r) {
    const RowStiffness s =
        r < rows ? row_stiffness(moduli_[r], grid_.thickness[r], k) : row_stiffness(below_, deep_[r - rows], k);
    const bool fixed = r == rows + static_cast<int>(deep_.size()) - 1;  // the lower node is at rest
    Mat2 u;
    double m_u = 0;
    if (!fixed) {
      d = s.lower + under;
      m = s.m_same + m_under;
      u = s.across * inverse(d);
      m_u = s.m_across / m;
    }
    if (r < rows) {
      wave[r + 1].inverse = inverse(d);
      wave[r + 1].m_inverse = 1 / m;
      wave[r].below = u;
      wave[r].m_below = m_u;
    }
    under = s.upper - u * transposed(s.across);
    m_under = s.m_same - m_u * s.m_across;
  }
  wave[0].inverse = inverse(under);
  wave[0].m_inverse = 1 / m_under;
}

void PlasticStrainResponse::solve(int kx, int ky, bool with_surface, const std::vector<int>& counting) const {
  const int rows = grid_.rows(), end = counting.empty() ? 0 : counting.back() + 1;  // of what has to be known
  const std::size_t plane = static_cast<std::size_t>(grid_.nx) * static_cast<std::size_t>(width_);
  const Spectrum spectrum{spectrum_.data() + static_cast<std::size_t>(kx) * width_ + ky, plane, rows};
  const Spectrum surface{&spectrum(6, 0), plane, 1};
  // x falls from station to station
  const double x = -wave_number(kx, grid_.nx, grid_.dx), y = grid_.ny > 1 ? wave_number(ky, grid_.ny, grid_.dy) : 0;
  const double k = std::hypot(x, y);
  if (std::isnan(k)) {
    for (int c = 0; c < 6; ++c)
      for (const int r : counting) spectrum(c, r) = 0;
    for (int c = 0; c < 3; ++c) surface(c, 0) = 0;
    return;
  }
  const Direction along{k, k > 0 ? x / k : 1, k > 0 ? y / k : 0};
  const int folded = 2 * kx > grid_.nx ? grid_.nx - kx : kx;
  const Wave* wave =
      factors_.data() + (static_cast<std::size_t>(folded) * width_ + ky) * static_cast<std::size_t>(rows + 1);
  thread_local std::vector<Node> u;
  u.assign(static_cast<std::size_t>(end + 1), {});
  for (const int r : counting)
    add_load(spectrum, r, along, grid_.thickness[r], moduli_[r].mu, u[static_cast<std::size_t>(r)],
             u[static_cast<std::size_t>(r + 1)]);
  for (int r = end - 1; r >= 0; --r) u[r] = less(u[r], wave[r].below, wave[r].m_below, u[r + 1]);
  for (int r = 0; r <= end; ++r) {
    u[r] = less({}, scaled(-1, wave[r].inverse), -wave[r].m_inverse, u[r]);
    if (r > 0) u[r] = less(u[r], transposed(wave[r - 1].below), wave[r - 1].m_below, u[r - 1]);
  }
  for (const int r : counting)
    put_strain(u[static_cast<std::size_t>(r)], u[static_cast<std::size_t>(r + 1)], along, grid_.thickness[r], spectrum,
               r);
  if (with_surface) put_surface(u.front(), along, surface);
}

void PlasticStrainResponse::apply(Field& field, Field* surface, const std::vector<bool>& rows) const {
  if (field.size() != grid_.size()) throw std::invalid_argument("PlasticStrainResponse: a field of another grid");
  std::vector<int> counting;
  for (int r = 0; r < grid_.rows(); ++r)
    if (rows.empty() || rows[static_cast<std::size_t>(r)]) counting.push_back(r);
  std::vector<int> planes;
  for (int c = 0; c < 6; ++c)
    for (const int r : counting) planes.push_back(c * grid_.rows() + r);
  const std::size_t real = grid_.plane(), complex = static_cast<std::size_t>(grid_.nx) * width_;
  const auto strains = static_cast<std::ptrdiff_t>(planes.size());
  for_each(strains, [&](std::ptrdiff_t k) {
    const int p = planes[static_cast<std::size_t>(k)];
    fft_->forward(field.data() + p * real, spectrum_.data() + p * complex);
  });
  for_each(grid_.nx, [&](std::ptrdiff_t kx) {
    for (int ky = 0; ky < width_; ++ky) solve(static_cast<int>(kx), ky, surface != nullptr, counting);
  });
  if (surface) surface->resize(3 * real);
  const double scale = 1 / static_cast<double>(real);
  for_each(surface ? strains + 3 : strains, [&](std::ptrdiff_t k) {
    const std::ptrdiff_t p = k < strains ? planes[static_cast<std::size_t>(k)] : 6 * grid_.rows() + k - strains;
    double* out = k < strains ? field.data() + p * real : surface->data() + (k - strains) * real;
    fft_->backward(spectrum_.data() + p * complex, out);
    for (std::size_t n = 0; n < real; ++n) out[n] *= scale;
  });
}

}  // namespace railstrata
