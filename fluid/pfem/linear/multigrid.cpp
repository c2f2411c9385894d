#include "fluid/pfem/linear/multigrid.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "fluid/pfem/linear/amg_levels.hpp"
#include "fluid/pfem/parallel.hpp"

namespace splashdown::fluid {
namespace {

// Where the diagonal dominates no row depends on others, and levels end early: smoothing solves such systems.
constexpr int most_dense = 1000;
constexpr int most_iterations = 2000;  // validation cases need 20, viscous layers on slivers several hundred
constexpr int most_blocks = 4;         // of Gauss-Seidel; between them it is Jacobi, which converges more slowly
constexpr int rows_a_block = 1000;     // at least; also of partial sums

/// visit(first, last, number) for a division of rows that does not depend on threads.
template <class Visit>
void in_blocks(int rows, int size, Visit visit) {
  const int blocks = (rows + size - 1) / size;
  in_pieces(static_cast<std::size_t>(blocks), 1, [&](std::size_t from, std::size_t to) {
    for (int b = static_cast<int>(from); b < static_cast<int>(to); ++b)
      visit(b * size, std::min(rows, (b + 1) * size), b);
  });
}
int smoothing_block(int rows) { return std::max(rows_a_block, (rows + most_blocks - 1) / most_blocks); }

Rows<float> transposed(const Rows<float>& m, int columns) {
  Rows<float> t;
  sort_entries(static_cast<std::size_t>(m.size()), static_cast<std::size_t>(columns), t, [&](std::size_t i, auto put) {
    for (int k = m.start[i]; k < m.start[i + 1]; ++k) put(m.column[k], static_cast<int>(i), m.value[k]);
  });
  return t;
}

// y = sign * M x + y for K columns side by side.
template <int K, class Real>
void add_product(const Rows<Real>& m, Real sign, const Real* x, Real* y) {
  in_blocks(m.size(), rows_a_block, [&](int first, int last, int) {
    for (int i = first; i < last; ++i) {
      std::array<Real, K> sum{};
      for (int k = m.start[i]; k < m.start[i + 1]; ++k)
        for (int c = 0; c < K; ++c) sum[c] += m.value[k] * x[m.column[k] * K + c];
      for (int c = 0; c < K; ++c) y[i * K + c] += sign * sum[c];
    }
  });
}

template <int K>
std::array<double, K> dot(int rows, const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<std::array<double, K>> part((rows + rows_a_block - 1) / rows_a_block);
  in_blocks(rows, rows_a_block, [&](int first, int last, int block) {
    std::array<double, K> sum{};
    for (int i = first; i < last; ++i)
      for (int c = 0; c < K; ++c) sum[c] += a[i * K + c] * b[i * K + c];
    part[block] = sum;
  });
  std::array<double, K> sum{};
  for (const auto& p : part)
    for (int c = 0; c < K; ++c) sum[c] += p[c];
  return sum;
}

}  // namespace

struct Multigrid::Level {
  Rows<float> matrix, interpolation, restriction;  // to this level and from it
  // Entries of a row i, in a block of rows: those in the block before i, ascending; from `rest` those in it from i on, descending;
  // from `beyond` those outside. The last ones of the first two are the last that sweeps find: their sums wait for no others.
  std::vector<int> rest, beyond;
  std::vector<float> diagonal, per_diagonal;  // a_ii + sum of |a_ij| beyond the block, and one over it
  std::vector<float> b, x, before;

  void prepare_smoothing() {
    rest.resize(matrix.size());
    beyond.resize(matrix.size());
    diagonal.resize(matrix.size());
    per_diagonal.resize(matrix.size());
    in_blocks(matrix.size(), smoothing_block(matrix.size()), [&](int first, int last, int) {
      std::vector<std::pair<int, float>> later, outside;
      for (int i = first; i < last; ++i) {
        later.clear();
        outside.clear();
        int to = matrix.start[i];
        auto put = [&](int j, float a) {
          matrix.column[to] = j;
          matrix.value[to++] = a;
        };
        float sum = 0;
        for (int k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
          const int j = matrix.column[k];
          const float a = matrix.value[k];
          if (j < first || j >= last) {
            sum += std::abs(a);
            outside.emplace_back(j, a);
          } else if (j < i) {
            put(j, a);
          } else {
            if (j == i) sum += a;
            later.emplace_back(j, a);
          }
        }
        rest[i] = to;
        for (auto entry = later.rbegin(); entry != later.rend(); ++entry) put(entry->first, entry->second);
        beyond[i] = to;
        for (const auto& [j, a] : outside) put(j, a);
        diagonal[i] = sum;
        per_diagonal[i] = sum > 0 ? 1 / sum : 0;
      }
    });
  }

  /// x after a forward sweep from zero, and what it leaves of b in `before`: together one pass over the matrix.
  template <int K>
  void smooth_forward() {
    in_blocks(matrix.size(), smoothing_block(matrix.size()), [&](int first, int last, int) {
      for (int i = first; i < last; ++i) {
        std::array<float, K> r;
        for (int c = 0; c < K; ++c) r[c] = b[i * K + c];
        for (int k = matrix.start[i]; k < rest[i]; ++k)
          for (int c = 0; c < K; ++c) r[c] -= matrix.value[k] * x[matrix.column[k] * K + c];
        for (int c = 0; c < K; ++c) x[i * K + c] = per_diagonal[i] * r[c];
      }
    });
    before.resize(x.size());
    in_blocks(matrix.size(), rows_a_block, [&](int first, int last, int) {
      for (int i = first; i < last; ++i) {
        std::array<float, K> r;
        for (int c = 0; c < K; ++c) r[c] = diagonal[i] * x[i * K + c];  // what was left when its turn came
        for (int k = rest[i]; k < matrix.start[i + 1]; ++k)
          for (int c = 0; c < K; ++c) r[c] -= matrix.value[k] * x[matrix.column[k] * K + c];
        for (int c = 0; c < K; ++c) before[i * K + c] = r[c];
      }
    });
  }

  template <int K>
  void smooth_backward() {
    before = x;
    in_blocks(matrix.size(), smoothing_block(matrix.size()), [&](int first, int last, int) {
      for (int i = last - 1; i >= first; --i) {
        std::array<float, K> r;
        for (int c = 0; c < K; ++c) r[c] = b[i * K + c];
        for (int k = beyond[i]; k < matrix.start[i + 1]; ++k)
          for (int c = 0; c < K; ++c) r[c] -= matrix.value[k] * before[matrix.column[k] * K + c];
        for (int k = matrix.start[i]; k < beyond[i]; ++k)
          for (int c = 0; c < K; ++c) r[c] -= matrix.value[k] * x[matrix.column[k] * K + c];
        for (int c = 0; c < K; ++c) x[i * K + c] += per_diagonal[i] * r[c];
      }
    });
  }
};

struct Multigrid::Hierarchy {
  Rows<double> matrix;
  std::vector<Level> levels;
  Eigen::LDLT<Eigen::MatrixXd> coarsest;
  std::vector<double> r, z, p, q, x;

  explicit Hierarchy(const SymmetricMatrix& m) : matrix(whole(m)) {
    AmgLevels built = amg_levels(matrix);
    levels.resize(built.matrix.size());
    for (std::size_t l = 0; l < levels.size(); ++l) {
      levels[l].matrix = std::move(built.matrix[l]);
      levels[l].prepare_smoothing();
      if (l + 1 == levels.size()) continue;
      levels[l].interpolation = std::move(built.interpolation[l]);
      levels[l].restriction = transposed(levels[l].interpolation, built.matrix[l + 1].size());
    }
    const auto& last = levels.back().matrix;
    if (last.size() > most_dense) return;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(last.size(), last.size());
    for (int i = 0; i < last.size(); ++i)
      for (int k = last.start[i]; k < last.start[i + 1]; ++k) dense(i, last.column[k]) += last.value[k];
    coarsest.compute(dense);
  }

  // levels[l].x = M^-1 levels[l].b
  template <int K>
  void cycle(std::size_t l) {
    Level& level = levels[l];
    const int n = level.matrix.size();
    level.x.resize(level.b.size());
    if (l + 1 == levels.size() && n > most_dense) {
      level.template smooth_forward<K>();
      level.template smooth_backward<K>();
      return;
    }
    if (l + 1 == levels.size()) {
      using Columns = Eigen::Matrix<float, Eigen::Dynamic, K, K == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
      const Eigen::Map<const Columns> b(level.b.data(), n, K);
      Eigen::Map<Columns>(level.x.data(), n, K) = coarsest.solve(b.template cast<double>()).template cast<float>();
      return;
    }
    level.template smooth_forward<K>();
    Level& coarser = levels[l + 1];
    coarser.b.assign(static_cast<std::size_t>(coarser.matrix.size()) * K, 0);
    add_product<K, float>(level.restriction, 1, level.before.data(), coarser.b.data());
    cycle<K>(l + 1);
    add_product<K, float>(level.interpolation, 1, coarser.x.data(), level.x.data());
    level.template smooth_backward<K>();
  }

  // z = M^-1 r. Residuals are scaled to their largest size: single precision ends at 1e-38.
  template <int K>
  void precondition() {
    const double largest = -least_in_parallel(r.size(), [&](std::size_t i) { return -std::abs(r[i]); });
    const double up = largest > 0 ? 1 / largest : 1;
    auto& finest = levels.front();
    finest.b.resize(r.size());
    in_parallel(r.size(), [&](std::size_t i) { finest.b[i] = static_cast<float>(up * r[i]); });
    cycle<K>(0);
    in_parallel(r.size(), [&](std::size_t i) { z[i] = finest.x[i] / up; });
  }

  /// K systems side by side; each stops for itself.
  template <int K>
  bool solve(double* rhs, double tolerance, const double* guess) {
    const int n = matrix.size();
    const std::size_t count = static_cast<std::size_t>(n) * K;
    for (auto* v : {&r, &z, &p, &q, &x}) v->assign(count, 0.0);
    auto side_by_side = [&](const double* columns, std::vector<double>& rows) {
      for (int c = 0; c < K; ++c)
        for (int i = 0; i < n; ++i)
          rows[static_cast<std::size_t>(i) * K + c] = columns[static_cast<std::size_t>(c) * n + i];
    };
    side_by_side(rhs, r);
    std::array<double, K> goal = dot<K>(n, r, r), rz{};
    if (guess != nullptr) {
      side_by_side(guess, x);
      add_product<K, double>(matrix, -1, x.data(), r.data());
      const auto left = dot<K>(n, r, r);
      for (int c = 0; c < K; ++c)
        if (!(left[c] < goal[c])) {  // it is no better than zero
          side_by_side(rhs, r);
          x.assign(count, 0.0);
          break;
        }
    }
    for (double& g : goal) g *= tolerance * tolerance;
    bool done = false;
    for (int iteration = 0; iteration <= most_iterations; ++iteration) {
      const auto rr = dot<K>(n, r, r);
      std::array<bool, K> open;
      done = true;
      for (int c = 0; c < K; ++c) {
        open[c] = !(rr[c] <= goal[c]);
        done = done && !open[c];
        if (!std::isfinite(rr[c])) return false;
      }
      if (done) break;
      precondition<K>();
      const auto rz_next = dot<K>(n, r, z);
      std::array<double, K> beta, alpha;
      for (int c = 0; c < K; ++c) beta[c] = iteration > 0 && rz[c] > 0 ? rz_next[c] / rz[c] : 0;
      rz = rz_next;
      in_parallel(static_cast<std::size_t>(n), [&](std::size_t i) {
        for (int c = 0; c < K; ++c) p[i * K + c] = z[i * K + c] + beta[c] * p[i * K + c], q[i * K + c] = 0;
      });
      add_product<K, double>(matrix, 1, p.data(), q.data());
      const auto pq = dot<K>(n, p, q);
      for (int c = 0; c < K; ++c) alpha[c] = open[c] && pq[c] > 0 ? rz[c] / pq[c] : 0;
      in_parallel(static_cast<std::size_t>(n), [&](std::size_t i) {
        for (int c = 0; c < K; ++c) x[i * K + c] += alpha[c] * p[i * K + c], r[i * K + c] -= alpha[c] * q[i * K + c];
      });
    }
    for (int c = 0; c < K; ++c)
      for (int i = 0; i < n; ++i) rhs[static_cast<std::size_t>(c) * n + i] = x[static_cast<std::size_t>(i) * K + c];
    return done;
  }
};

Multigrid::Multigrid(const SymmetricMatrix& matrix) : h_(std::make_unique<Hierarchy>(matrix)) {}
Multigrid::~Multigrid() = default;

bool Multigrid::solve(std::span<double> rhs, int columns, double tolerance, std::span<const double> guess) {
  const std::size_t rows = rhs.size() / static_cast<std::size_t>(columns);
  auto from = [&](int column) { return guess.empty() ? nullptr : guess.data() + rows * column; };
  constexpr int together = 6;  // the freedoms of a body
  int c = 0;
  for (; columns - c >= together; c += together)
    if (!h_->solve<together>(rhs.data() + rows * c, tolerance, from(c))) return false;
  for (; columns - c >= 3; c += 3)
    if (!h_->solve<3>(rhs.data() + rows * c, tolerance, from(c))) return false;
  for (; c < columns; ++c)
    if (!h_->solve<1>(rhs.data() + rows * c, tolerance, from(c))) return false;
  return true;
}

}  // namespace splashdown::fluid
