/// @file
/// albedo-peers as its users call it: its accuracy columns are right. Its times are nobody's to assert.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "albedo/directional_albedo.hpp"

namespace albedo {
namespace {

/// An empty directory, gone with its owner.
class Directory {
 public:
  Directory() {
    std::string name = (std::filesystem::temp_directory_path() / "albedo-peers-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary directory");
    path_ = name;
  }
  ~Directory() { std::filesystem::remove_all(path_); }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;

  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

struct Outcome {
  int code;
  std::string out, err;
};

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Runs albedo-peers; arguments are plain words.
Outcome run_peers(const Directory& directory, const std::string& arguments) {
  const std::string out = directory.file("out"), err = directory.file("err");
  const std::string command = "'" ALBEDO_PEERS_PROGRAM "' " + arguments + " >'" + out + "' 2>'" + err + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(err)};
}

using nlohmann::json;

/// true_error is what value and reference say, and `reached` is what it says of the target; in lobe coordinates every
/// deterministic rule of cubature and Boost reaches 1e-8.
void check_peer(const json& peer, double reference, double target) {
  const bool monte_carlo = peer.contains("asked") && peer["asked"].contains("calls");
  for (const char* name : {"asked", "best"}) {
    if (!peer.contains(name) || peer[name]["value"].is_null() || monte_carlo) continue;
    const json& run = peer[name];
    const double error = std::abs(run["value"].get<double>() - reference) / reference;
    EXPECT_DOUBLE_EQ(run["true_error"].get<double>(), error) << peer;
  }
  EXPECT_EQ(peer["reached"].get<bool>(), peer.contains("best")) << peer;
  if (peer["reached"]) {
    EXPECT_LE(peer["best"]["true_error"].get<double>(), target) << peer;
    EXPECT_GT(peer["best"]["evaluations"].get<int>(), 0) << peer;
  }
  if (peer["silently_wrong"]) {
    EXPECT_TRUE(peer["asked"]["claims_converged"].get<bool>()) << peer;
    EXPECT_GT(peer["asked"]["true_error"].get<double>(), 10 * target) << peer;
  }
  if (peer["coordinates"] == "lobe" && peer["library"] != "gsl" && target >= 1e-8) {
    EXPECT_TRUE(peer["reached"]) << peer;
  }
}

TEST(Peers, AccuracyColumnsAreRight) {
  const Directory directory;
  const std::string file = directory.file("peers.json");
  const Outcome outcome = run_peers(directory, "--quick --repeats 1 --json '" + file + "'");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("the best scalar library rule"), std::string::npos) << outcome.out;
  const json report = json::parse(text_of(file));
  ASSERT_EQ(report["cases"].size(), 15U);
  for (const json& one : report["cases"]) {
    Parameters parameters;
    for (const auto& [name, value] : one["parameters"].items()) parameters.emplace_back(name, value.get<double>());
    const std::unique_ptr<Model> model = make_model(one["model"].get<std::string>(), parameters);
    // another rule than the reference's, in another arithmetic
    const Estimate nested = directional_albedo(*model, Direction::from_degrees(one["theta_deg"].get<double>()),
                                               {.rule = Rule::kronrod, .tolerance = 1e-9});
    const double reference = one["reference"].get<double>();
    EXPECT_NEAR(nested.value, reference, nested.error + 1e-12) << one["model"] << one["theta_deg"];
    if (one["model"] == "phong" && one["theta_deg"] == 0) {
      EXPECT_NEAR(reference, 1, 1e-13);  // Neumann 1999, eq. 22
    }
    EXPECT_LE(one["reference_error"].get<double>(), 1e-13 * reference);
    ASSERT_EQ(one["targets"].size(), 4U);
    for (const json& target : one["targets"]) {
      const json& gauss = target["gauss"];
      const double error = std::abs(gauss["value"].get<double>() - reference) / reference;
      EXPECT_DOUBLE_EQ(gauss["true_error"].get<double>(), error);
      EXPECT_LE(error, target["target"].get<double>()) << one["model"] << one["theta_deg"];
      EXPECT_EQ(gauss["status"], "converged");
      for (const json& peer : target["peers"]) check_peer(peer, reference, target["target"].get<double>());
    }
  }
}

TEST(Peers, WrongInputIsOneLineAndExitCode2) {
  for (const char* arguments : {"--repeats 0", "--repeats many", "--quik", "surplus", "--json"}) {
    const Directory directory;
    const Outcome outcome = run_peers(directory, arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("albedo-peers: ", 0), 0U) << outcome.err;
  }
}

TEST(Peers, ReportThatCannotBeWrittenIsExitCode4) {
  const Directory directory;
  EXPECT_EQ(run_peers(directory, "--quick --json '" + directory.file("missing/peers.json") + "'").code, 4);
}

TEST(Peers, HelpIsGiven) {
  const Directory directory;
  const Outcome outcome = run_peers(directory, "--help");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.out.find("--json"), std::string::npos);
}

}  // namespace
}  // namespace albedo
