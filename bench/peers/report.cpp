#include "peers/report.hpp"

#include <cstdlib>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <thread>

namespace albedo::peers {
namespace {

constexpr int name_width = 74, cell_width = 18;

std::string digits(double value, int precision) {
  if (std::isnan(value)) return "-";
  std::ostringstream text;
  if (value >= 100) {
    text << std::fixed << std::setprecision(0) << value;
  } else {
    text << std::setprecision(precision) << value;
  }
  return text.str();
}

std::string scientific(double value) {
  std::ostringstream text;
  text << std::scientific << std::setprecision(0) << value;
  return text.str();
}

std::string name_of(const CaseResult& result) {
  std::ostringstream text;
  text << result.material.model << ' ' << result.material.parameter << '=' << result.material.value << " at "
       << result.theta << " deg";
  return text.str();
}

std::string name_of(const PeerResult& peer) {
  return peer.peer->library + " " + peer.peer->rule + ", " + std::string(to_string(peer.coordinates));
}

/// A row: a name, and a cell for each target.
template <class Cell>
void row(std::ostream& out, const std::string& name, std::size_t targets, const Cell& cell) {
  out << std::left << std::setw(name_width) << name << std::right;
  for (std::size_t i = 0; i < targets; ++i) out << std::setw(cell_width) << cell(i);
  out << '\n';
}

class Report {
 public:
  Report(std::ostream& out, const std::vector<CaseResult>& results) : out_(out), results_(results) {}

  void baselines_table() const {
    out_ << "Median over the cases of the peer's time / the time of gauss (its error estimate included); the smallest "
            "ratio; right cases\n";
    heading("against");
    for (const Baseline& baseline : baselines()) {
      const std::vector<Ratios> all = ratios(baseline, results_);
      row(out_, baseline.name, targets(), [&](std::size_t i) {
        const Ratios& ratios = all[i];
        return digits(ratios.median(), 3) + "; " + digits(ratios.smallest(), 2) + "; " +
               std::to_string(ratios.values.size());
      });
    }
  }

  void gauss_table() const {
    heading("gauss");
    const auto over_cases = [this](std::size_t i, const auto& number) {
      std::vector<double> values;
      for (const CaseResult& result : results_) values.push_back(static_cast<double>(number(result.targets[i])));
      return values;
    };
    row(out_, "evaluations, error estimate included: median / worst", targets(), [&](std::size_t i) {
      const auto values = over_cases(i, [](const TargetResult& t) { return t.gauss.estimate.evaluations; });
      return digits(median(values), 6) + " / " + digits(*std::max_element(values.begin(), values.end()), 6);
    });
    row(out_, "microseconds: median / worst", targets(), [&](std::size_t i) {
      const auto values = over_cases(i, [](const TargetResult& t) { return 1e6 * t.gauss.seconds; });
      return digits(median(values), 3) + " / " + digits(*std::max_element(values.begin(), values.end()), 3);
    });
    row(out_, "largest true error / target", targets(), [&](std::size_t i) {
      const auto values = over_cases(i, [](const TargetResult& t) { return t.gauss.true_error / t.target; });
      return digits(*std::max_element(values.begin(), values.end()), 2);
    });
    row(out_, "converged, and right", targets(), [&](std::size_t i) {
      const auto right =
          std::ranges::count_if(results_, [&](const CaseResult& result) { return is_right(result.targets[i]); });
      return std::to_string(right) + " of " + std::to_string(results_.size());
    });
  }

  /// Every rule in each of the coordinates: the median ratio where it gets there, and in how many cases it does.
  void peers_table() const {
    heading("each rule, tuned with the answer known: median ratio; cases that it reaches");
    for_each_peer([this](std::size_t k, const std::string& name) {
      row(out_, name, targets(), [&](std::size_t i) {
        std::vector<double> values;
        for (const CaseResult& result : results_) {
          const PeerResult& peer = result.targets[i].peers[k];
          if (peer.reached) values.push_back(peer.timing.ratio);
        }
        return digits(median(values), 3) + "; " + std::to_string(values.size());
      });
    });
  }

  void wrong_table() const {
    heading("silently wrong: says that it met the target, is off by more than ten times it (cases)");
    for_each_peer([this](std::size_t k, const std::string& name) {
      const auto count = [&](std::size_t i) {
        return std::ranges::count_if(results_,
                                     [&](const CaseResult& r) { return r.targets[i].peers[k].silently_wrong; });
      };
      bool any = false;
      for (std::size_t i = 0; i < targets(); ++i) any = any || count(i) > 0;
      if (any) row(out_, name, targets(), [&](std::size_t i) { return std::to_string(count(i)); });
    });
    const auto silent = [this](std::size_t i) {
      return std::ranges::count_if(results_, [&](const CaseResult& r) {
        const TargetResult& target = r.targets[i];
        return target.gauss.estimate.status == Status::converged && target.gauss.true_error > 10 * target.target;
      });
    };
    row(out_, "gauss", targets(), [&](std::size_t i) { return std::to_string(silent(i)); });
  }

  void slower_list(bool vectorised) const {
    const std::vector<Slower> slower = slower_cases(results_, vectorised);
    out_ << "\nSlower than the best " << (vectorised ? "rule, scalar or in blocks" : "scalar rule") << ": "
         << slower.size() << " of " << results_.size() * targets() << '\n';
    for (const Slower& one : slower) {
      out_ << "  " << name_of(*one.result) << ", " << scientific(one.target) << ": "
           << digits(one.peer->timing.ratio, 2) << " (" << name_of(*one.peer) << ")\n";
    }
  }

 private:
  [[nodiscard]] std::size_t targets() const { return results_.front().targets.size(); }

  void heading(const std::string& name) const {
    out_ << '\n';
    row(out_, name, targets(), [&](std::size_t i) { return scientific(results_.front().targets[i].target); });
  }

  template <class Visit>
  void for_each_peer(const Visit& visit) const {
    const std::vector<PeerResult>& peers = results_.front().targets.front().peers;
    for (std::size_t k = 0; k < peers.size(); ++k) visit(k, name_of(peers[k]));
  }

  std::ostream& out_;
  const std::vector<CaseResult>& results_;
};

double one_minute_load() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : std::nan("");
}

}  // namespace

Machine Machine::look() {
  Machine machine{"unknown", static_cast<int>(std::thread::hardware_concurrency()), one_minute_load()};
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0) machine.processor = line.substr(line.find(':') + 2);
  }
  return machine;
}

void print_report(std::ostream& out, const std::vector<CaseResult>& results, const std::vector<Peer>& peers,
                  const Machine& machine) {
  out << results.size() << " integrals, " << peers.size() << " library rules in two kinds of coordinates; "
      << machine.processor << ", " << machine.cores << " cores, one thread, load " << machine.load_before << " to "
      << machine.load_after << "\n\n";
  const Report report(out, results);
  report.baselines_table();
  report.gauss_table();
  report.peers_table();
  report.wrong_table();
  report.slower_list(false);
  report.slower_list(true);
}

}  // namespace albedo::peers
