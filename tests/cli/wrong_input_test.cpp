// Wrong input: one clear line on standard error, exit code 2, nothing on standard output, nothing written.

#include <sstream>

#include "cli/program.hpp"

namespace albedo::test {
namespace {

struct Case {
  std::vector<std::string> arguments;
  std::string message;  ///< a part of the line
};

void PrintTo(const Case& wrong, std::ostream* out) {
  for (const std::string& argument : wrong.arguments) *out << " '" << argument << "'";
}

class WrongInput : public CliTest, public ::testing::WithParamInterface<Case> {};

TEST_P(WrongInput, IsRefusedInOneLine) {
  const Outcome outcome = run_albedo(GetParam().arguments);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().message), std::string::npos) << outcome.err;
  EXPECT_TRUE(files().empty());
}

/// `albedo at` with these words and a direction.
Case at(std::vector<std::string> words, std::string message) {
  words.insert(words.begin(), "at");
  words.insert(words.end(), {"--theta", "0"});
  return {std::move(words), std::move(message)};
}

INSTANTIATE_TEST_SUITE_P(
    Pumping, WrongInput,
    ::testing::Values(at({"phong", "--pump", "-1"}, "--pump is '-1' and must be a whole number within [0, 1000]"),
                      at({"phong", "--pump", "1e9"}, "--pump is '1e9'"), at({"phong", "--pump", "1001"}, "[0, 1000]"),
                      at({"phong", "--pump", "1", "--control", "steps"}, "must be one of none, step, total"),
                      at({"phong", "--control", "step"}, "--control requires --pump"),
                      at({"phong_original", "--pump", "1"}, "phong_original isn't reciprocal"),
                      at({"lambert", "rho=0", "--pump", "1"}, "the albedo of lambert is 0"),
                      Case{{"audit", "--pump", "1"}, "--pump requires MODEL"}, Case{{"pump"}, "no MODEL"},
                      Case{{"pump", "phong", "--times", "-1"}, "--times is '-1'"},
                      Case{{"pump", "phong", "--pump", "2"}, "unknown option '--pump'"},
                      Case{{"pump", "phong", "--tolerance", "0"}, "--tolerance is 0"},
                      Case{{"table", "phong_original", "n=1,2", "--pump", "1", "-o", "t.csv"},
                           "phong_original isn't reciprocal"},
                      Case{{"table", "shirley_matte", "--pump", "2", "-o", "t.csv"}, "vanishes at grazing incidence"},
                      at({"ggx", "--correct", "balance", "--rho", "1.5"}, "--rho is 1.5"),
                      at({"ggx", "--correct", "balnce"}, "did you mean 'balance'?"),
                      at({"ward", "--correct", "multiscatter"}, "doesn't claim to conserve energy"),
                      at({"ggx", "alpha_x=0.2", "--correct", "balance"}, "ggx is anisotropic"),
                      Case{{"shader", "ggx", "-o", "t.csv"}, "nothing is to be corrected"}));

INSTANTIATE_TEST_SUITE_P(Models, WrongInput,
                         ::testing::Values(at({"wardd"}, "unknown model 'wardd'; did you mean 'ward'?"),
                                           at({}, "no MODEL"), Case{{"models", "wardd"}, "did you mean 'ward'?"},
                                           Case{{"curve", "wardd"}, "did you mean 'ward'?"},
                                           Case{{"table", "wardd", "-o", "x.csv"}, "did you mean 'ward'?"}));

INSTANTIATE_TEST_SUITE_P(
    Parameters, WrongInput,
    ::testing::Values(at({"ward", "alpha=0"}, "alpha_x is 0 and must be within"),
                      at({"ward", "alpha=-1"}, "alpha_x is -1 and must be within"),
                      at({"ward", "alpha=nan"}, "alpha: 'nan'"), at({"ward", "alpha=inf"}, "alpha: 'inf'"),
                      at({"ward", "alpha=1e400"}, "alpha: '1e400'"),
                      at({"ward", "alpha=x"}, "alpha: 'x' is not a finite number"), at({"ward", "alpha="}, "alpha: ''"),
                      at({"ward", "alpha=0.1x"}, "alpha: '0.1x'"), at({"ward", "alhpa=0.1"}, "did you mean 'alpha'?"),
                      at({"ward", "alpha"}, "'alpha' is not of the form NAME=VALUE"),
                      at({"ward", "alpha=0.1", "alpha_x=0.2"}, "alpha_x is set twice"),
                      at({"kurt", "equation=12"}, "one of 9, 10, 11, 13"),
                      at({"ggx", "masking=smith"}, "correlated, separable")));

INSTANTIATE_TEST_SUITE_P(
    Sums, WrongInput,
    ::testing::Values(at({"sum"}, "sum has no parts"), at({"sum", "wardd:alpha=0.1"}, "did you mean 'ward'?"),
                      at({"sum", "rho=0.2"}, "'rho=0.2' is not of the form"), at({"sum", ""}, "'' is not of the form"),
                      at({"sum", "lambert:rho"}, "'rho' is not of the form NAME=VALUE"),
                      at({"sum", "lambert:"}, "'' is not of the form NAME=VALUE"),
                      at({"sum", "lambert:rho=0.2,"}, "'' is not of the form NAME=VALUE"),
                      at({"sum", "lambert:rho=2"}, "rho is 2 and must be within [0, 1]"),
                      at({"sum", "ward:alpha=0.1,alpha_x=0.2"}, "alpha_x is set twice"),
                      at({"sum", "lambert:weight=-1"}, "the weight of part 1 is -1 and must be within [0, 1e+06]"),
                      at({"sum", "lambert:weight=x"}, "weight: 'x' is not a finite number"),
                      at({"sum", "lambert:weight=1,weight=2"}, "weight set twice"),
                      at({"sum", "sum:lambert"}, "'sum:lambert' is not a model of its own and can't be a part"),
                      Case{{"table", "sum", "lambert:rho=0.1:0.5:3", "-o", "x.csv"},
                           "'0.1:0.5:3' is not a finite number"}));

INSTANTIATE_TEST_SUITE_P(
    Options, WrongInput,
    ::testing::Values(
        Case{{"at", "ward", "--theta", "91"}, "--theta: '91'"}, Case{{"at", "ward", "--theta", "-1"}, "--theta: '-1'"},
        Case{{"at", "ward", "--theta", ""}, "--theta: ''"}, Case{{"at", "ward", "--theta", "0,,1"}, "--theta: ''"},
        Case{{"at", "ward", "--theta="}, "--theta"}, Case{{"at", "ward"}, "--theta is required"},
        at({"ward", "--phi", "inf"}, "--phi: 'inf'"), at({"ward", "--tolerance", "0"}, "--tolerance is 0"),
        at({"ward", "--tolerance", "1"}, "must be within [1e-30, 1)"),
        at({"ward", "--tolerance", "nan"}, "--tolerance: 'nan'"), at({"ward", "--budget", "0"}, "--budget is '0'"),
        at({"ward", "--budget", "1e3"}, "--budget is '1e3'"), at({"ward", "--threads", "0"}, "within [1, 1024]"),
        at({"ward", "--threads", "1025"}, "within [1, 1024]"), at({"ward", "--seed", "-1"}, "--seed is '-1'"),
        at({"ward", "--rule", "simpson"},
           "--rule is 'simpson' and must be one of gauss, cubature, kronrod, tanh_sinh, stratified, "
           "sobol, monte_carlo"),
        at({"ward", "--rule", "kronord"}, "did you mean 'kronrod'?"),
        at({"ward", "--warp", "polar"}, "one of lobe, hemisphere, paper"),
        at({"ward", "--precision", "half"}, "one of double, float, quad"),
        at({"ward", "--tolerence", "1e-3"}, "did you mean '--tolerance'?"),
        at({"ward", "--assert", "max=1"}, "at character 4"),
        at({"ward", "--assert", "at(60)<1"}, "not among those of --theta and --phi"),
        Case{{"curve", "ward", "--phi", "30", "--assert", "at(60)<1"}, "another --phi"},
        Case{{"curve", "ward", "--json", "-o", "-"}, "standard output"}));

INSTANTIATE_TEST_SUITE_P(Subcommands, WrongInput,
                         ::testing::Values(Case{{"tabel"}, "unknown subcommand 'tabel'; did you mean 'table'?"},
                                           Case{{"--jsno"}, "'--jsno'"},
                                           Case{{"models", "--json", "--markdown"}, "--json"}));

INSTANTIATE_TEST_SUITE_P(
    Tables, WrongInput,
    ::testing::Values(Case{{"table", "ggx"}, "--output is required"}, Case{{"table", "ggx", "-o", "x"}, "no ending"},
                      Case{{"table", "ggx", "-o", "x.txt"}, "unknown ending '.txt'"},
                      Case{{"table", "ggx", "-o", "."}, "'.'"}, Case{{"table", "ggx", "-o", ""}, "no ending"},
                      Case{{"curve", "ggx", "-o", "x.txt"}, "'.txt'"}, Case{{"table", "-o", "x.csv"}, "no MODEL"},
                      Case{{"table", "ggx", "alpha=0:1:3", "-o", "x.csv"}, "alpha_x is 0"},
                      Case{{"table", "ggx", "alpha=0.1:1", "-o", "x.csv"}, "FROM:TO:COUNT"},
                      Case{{"table", "ggx", "alpha=0.1:1:0", "-o", "x.csv"}, "count"},
                      Case{{"table", "ggx", "alhpa=0.1:1:3", "-o", "x.csv"}, "did you mean 'alpha'?"},
                      Case{{"table", "ggx", "alpha=0.1:1:3", "alpha_x=0.3", "-o", "x.csv"}, "alpha_x is set twice"},
                      Case{{"table", "ggx", "masking=correlated,smith", "-o", "x.csv"}, "masking is 'smith'"},
                      Case{{"table", "ggx", "theta=0:91:5", "-o", "x.csv"}, "91"},
                      Case{{"table", "ggx", "cos_theta=0:2:5", "-o", "x.csv"}, "cos_theta is "},
                      Case{{"table", "ggx", "theta=0,1", "cos_theta=1", "-o", "x.csv"}, "polar angle is given twice"},
                      Case{{"table", "ggx", "alpha=0.1:1:1000000", "phi=0:360:1000000", "-o", "x.csv"}, "entries"},
                      Case{{"table", "ggx", "alpha=0.1,0.2", "-o", "x.csv", "--assert", "at(60)<1"},
                           "can't be answered"},
                      Case{{"table", "ggx", "-o", "-", "--json"}, "standard output"},
                      Case{{"table", "--materials", "missing.json", "-o", "x.csv"}, "cannot read 'missing.json'"},
                      Case{{"table", "--materials", ".", "-o", "x.csv"}, "cannot read '.'"}));

INSTANTIATE_TEST_SUITE_P(Tradeoffs, WrongInput,
                         ::testing::Values(Case{{"tradeoff", "wardd"}, "unknown model 'wardd'; did you mean 'ward'?"},
                                           Case{{"tradeoff", "n=20"}, "'n=20' comes before any MODEL"},
                                           Case{{"tradeoff", "phong", "m=20"}, "phong has no"},
                                           Case{{"tradeoff", "phong", "--rule", "gaus"}, "did you mean 'gauss'?"},
                                           Case{{"tradeoff", "phong", "--rule", "gauss,,sobol"}, "--rule is ''"},
                                           Case{{"tradeoff", "phong", "--rule", ""}, "--rule is ''"},
                                           Case{{"tradeoff", "phong", "--warp", "polar"},
                                                "one of lobe, hemisphere, paper"},
                                           Case{{"tradeoff", "phong", "--theta", "90"}, "must be within [0, 90)"},
                                           Case{{"tradeoff", "phong", "--tolerance", "0"}, "--tolerance is 0"},
                                           Case{{"tradeoff", "phong", "--repeat", "0"}, "--repeat is '0'"},
                                           Case{{"tradeoff", "phong", "-o", "x.npy"}, "must end in .csv or .json"},
                                           Case{{"tradeoff", "phong", "--json", "-o", "-"}, "standard output"}));

/// What a materials file holds, and what is said of it.
struct BadFile {
  std::string text;
  std::string message;
};

class WrongMaterials : public CliTest, public ::testing::WithParamInterface<BadFile> {};

TEST_P(WrongMaterials, AreRefusedWithTheirLine) {
  write_text("materials.json", GetParam().text);
  const Outcome outcome = run_albedo({"table", "--materials", "materials.json", "-o", "x.csv"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(line_count(outcome.err), 1U) << outcome.err;
  EXPECT_NE(outcome.err.find("'materials.json'"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().message), std::string::npos) << outcome.err;
  EXPECT_EQ(files(), std::vector<std::string>{"materials.json"});
}

/// Forty lines; the last one is `last`.
std::string forty_lines(const std::string& last) {
  std::string text;
  for (int i = 1; i < 40; ++i)
    text += R"({"name": "a", "model": "ward", "parameters": {"alpha": 0.1}})"
            "\n";
  return text + last + "\n";
}

INSTANTIATE_TEST_SUITE_P(
    Files, WrongMaterials,
    ::testing::Values(
        BadFile{"", "empty"}, BadFile{"[]", "no materials"}, BadFile{"name,model\nx,ward\n", "line 1"},
        BadFile{R"([{"name": "a", "model": "ward", "parameters": {"alp)", "cut off"},
        BadFile{forty_lines(R"({"name": "a", "model": "wardd", "parameters": {}})"),
                "line 40: unknown model 'wardd'; did you mean 'ward'?"},
        BadFile{forty_lines(R"({"name": "a", "model": "ward", "parameters": {"alhpa": 1}})"), "line 40: ward has no"},
        BadFile{forty_lines(R"({"name": "a", "model": "ward", "parameters": {"alpha": 0}})"),
                "line 40: ward: alpha_x is 0"},
        BadFile{forty_lines(R"({"name": "a", "model": "ward", "parameters": {"alpha": [0.1, 0.2, 0.3]}})"),
                "line 40: ward: alpha is one number for all channels"}));

TEST_F(CliTest, NoSubcommandIsAnsweredWithHelpOnStandardError) {
  const Outcome outcome = run_albedo({});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("Usage: albedo"), std::string::npos);
}

}  // namespace
}  // namespace albedo::test
