#include "cli/figures.hpp"

namespace albedo::test::figures {
namespace {

TEST_F(Figures, AreListed) {
  const Outcome outcome = run("--list");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(outcome.out.starts_with("neumann-1 ")) << outcome.out;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(names(), Names{});
}

TEST_F(Figures, OfUnknownNameSuggestTheRightOne) {
  const Outcome outcome = run("neuman-1 --output new");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "albedo-figures: unknown figure 'neuman-1'; did you mean 'neumann-1'?\n");
  EXPECT_FALSE(fs::exists(directory_ / "new"));
}

TEST_F(Figures, WantOneClearLineOfUsage) {
  for (const char* const arguments : {"", "--format png", "--all --format gif", "--all --format ''", "--all --format",
                                      "--all --fromat png", "neumann-1 --output", "neumann-1 other"}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_TRUE(outcome.err.starts_with("albedo-figures: ")) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(names("."), (Names{"out", "stderr.txt", "stdout.txt"})) << arguments;
  }
}

TEST_F(Figures, HaveHelpWithAnExample) {
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(contains(outcome.out, "Example: albedo-figures neumann-1")) << outcome.out;
}

TEST_F(Figures, CannotGoWhereNoDirectoryCanBe) {
  std::ofstream(directory_ / "file") << "kept";
  for (const char* const where : {"file", "file/below", "/proc/albedo"}) {
    const Outcome outcome = run("neumann-1 --data-only --output " + std::string(where));
    EXPECT_EQ(outcome.exit_code, 4) << where;
    EXPECT_TRUE(contains(outcome.err, "cannot write '" + std::string(where) + "'")) << outcome.err;
  }
  EXPECT_EQ(read(directory_ / "file"), "kept");
}

TEST_F(Figures, AreWrittenWholeOrNotAtAll) {
  fs::create_directory(directory_ / "out/neumann-1.pdf");
  const Outcome outcome = run("neumann-1 --output out");
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_TRUE(contains(outcome.err, "cannot write 'out/neumann-1.pdf'")) << outcome.err;
  EXPECT_EQ(names(), Names{"neumann-1.pdf"});
}

TEST_F(Figures, DataOnlyWritesTheNumbersAndTheScript) {
  const Outcome outcome = run("neumann-1 --data-only --output new/out", "PATH=/nowhere");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_EQ(names("new/out"), (Names{"neumann-1.csv", "neumann-1.gp"}));

  Data data(directory_ / "new/out/neumann-1.csv");
  EXPECT_EQ(data.columns,
            (Names{"theta_l", "cos_theta_l", "phong", "phong_error", "he_torrance", "he_torrance_error",
                   "he_torrance_diffuse", "he_torrance_diffuse_error", "ward", "ward_error", "cook_torrance",
                   "cook_torrance_error", "cook_torrance_without_g", "cook_torrance_without_g_error"}));
  for (const auto& [column, values] : data.values) {
    EXPECT_GT(values.size(), 300U);
    EXPECT_TRUE(std::ranges::all_of(values, [](double value) { return std::isfinite(value) && value >= 0; })) << column;
  }
  EXPECT_TRUE(std::ranges::is_sorted(data.values["theta_l"]));
  EXPECT_EQ(data.values["theta_l"].front(), 0);
  EXPECT_EQ(data.values["cos_theta_l"].back(), 1e-8);
  EXPECT_EQ(data.header["command"], "albedo-figures neumann-1");
  EXPECT_EQ(data.header["not converged"], "0");
  EXPECT_TRUE(contains(data.header["curve ward"], "ward alpha_x=0.1")) << data.header["curve ward"];
}

TEST_F(Figures, Neumann1ShowsWhatIsKnown) {
  ASSERT_EQ(run("neumann-1 --data-only").exit_code, 0);
  Data data(directory_ / "neumann-1.csv");
  const auto& theta = data.values["theta_l"];
  const auto at_60 = std::ranges::find_if(theta, [](double value) { return std::abs(value - 60) < 1e-9; });
  ASSERT_NE(at_60, theta.end());
  const auto row = static_cast<std::size_t>(at_60 - theta.begin());
  // Ward: from an independent integration. Phong, n → ∞: cosθ, which n = 150 is near to.
  EXPECT_NEAR(data.values["ward"][row], 0.488988056485, 5e-9);
  EXPECT_NEAR(data.values["phong"][row], 0.5, 1e-4);
  EXPECT_NEAR(data.values["ward"][0], 0.971051675567, 1e-8);
  // He–Torrance's directional-diffuse part: three digits of an independent integration.
  EXPECT_NEAR(data.values["he_torrance_diffuse"][0], 0.998, 5e-4);
  EXPECT_NEAR(data.values["he_torrance_diffuse"][row], 0.780, 5e-4);
  // With G, Cook–Torrance ends at 1 instead of diverging.
  EXPECT_NEAR(data.values["cook_torrance"].back(), 1, 1e-6);
  EXPECT_NEAR(std::stod(data.header["grazing exponent of ward"]), -0.5, 1e-5);
  EXPECT_NEAR(std::stod(data.header["grazing exponent of cook_torrance_without_g"]), -1, 1e-5);
  EXPECT_NEAR(std::stod(data.header["grazing exponent of phong"]), 0, 1e-5);
}

TEST_F(Figures, NeedGnuplotForPictures) {
  const Outcome outcome = run("neumann-1 --output out", "PATH=/nowhere");
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_EQ(
      outcome.err,
      "albedo-figures: cannot draw 'neumann-1': gnuplot was not found; install it, or draw nothing with --data-only\n");
  EXPECT_EQ(names(), Names{});
}

TEST_F(Figures, ReportWhatGnuplotSays) {
  const Outcome outcome = run("neumann-1 --output out", with_fake_gnuplot("echo 'no such terminal' >&2; exit 1"));
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_EQ(outcome.err, "albedo-figures: cannot draw 'neumann-1': gnuplot failed: no such terminal\n");
  EXPECT_EQ(names(), Names{});
}

TEST_F(Figures, DoNotTakeGnuplotsWordForAPicture) {
  const Outcome outcome = run("neumann-1 --output out", with_fake_gnuplot("exec cat >/dev/null"));
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_TRUE(contains(outcome.err, "gnuplot made no pdf")) << outcome.err;
  EXPECT_EQ(names(), Names{});
}

TEST_F(Figures, AreDrawnInEveryFormatAndTheSameEveryTime) {
  if (!installed("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  const Outcome outcome = run("--format png neumann-1 --format pdf --format svg --format png --output out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  const Names files{"neumann-1.csv", "neumann-1.gp", "neumann-1.pdf", "neumann-1.png", "neumann-1.svg"};
  ASSERT_EQ(names(), files);
  EXPECT_TRUE(read(directory_ / "out/neumann-1.png").starts_with("\x89PNG\r\n\x1a\n"));
  EXPECT_TRUE(read(directory_ / "out/neumann-1.pdf").starts_with("%PDF-"));
  EXPECT_TRUE(contains(read(directory_ / "out/neumann-1.svg"), "</svg>"));

  ::sleep(1);  // so that a date in a picture would be another
  ASSERT_EQ(run("neumann-1 --format svg --format pdf --format png -o again", "TZ=Asia/Tokyo").exit_code, 0);
  for (const std::string& file : files) {
    EXPECT_EQ(read(directory_ / "out" / file), read(directory_ / "again" / file)) << file;
  }
}

TEST_F(Figures, BringTheirFontsAlong) {
  if (!installed("gnuplot") || !installed("pdffonts")) GTEST_SKIP() << "gnuplot or pdffonts is not installed";
  ASSERT_EQ(run("neumann-1").exit_code, 0);
  const std::string file = (directory_ / "neumann-1.pdf").string();
  const std::string list = (directory_ / "fonts.txt").string();
  ASSERT_EQ(std::system(("pdffonts '" + file + "' >'" + list + "'").c_str()), 0);
  std::ifstream fonts(list);
  std::string line;
  std::getline(fonts, line);
  const std::size_t embedded = line.find("emb");
  ASSERT_NE(embedded, std::string::npos) << line;
  std::getline(fonts, line);
  int count = 0;
  for (; std::getline(fonts, line); ++count) EXPECT_EQ(line.substr(embedded, 3), "yes") << line;
  EXPECT_GT(count, 0);
}

TEST_F(Figures, OfTheTradeoffShowWhatWasMeasured) {
  if (!installed("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  const Outcome outcome = run("tradeoff-phong --format png --format pdf --output out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(names(), (Names{"tradeoff-phong.csv", "tradeoff-phong.gp", "tradeoff-phong.pdf", "tradeoff-phong.png"}));
  const std::string data = read(directory_ / "out/tradeoff-phong.csv");
  const std::string script = read(directory_ / "out/tradeoff-phong.gp");
  for (const char* const part : {"\nphong,smooth,60,gauss,lobe,", "\nphong,rough,85,monte_carlo,paper,",
                                 "# command: albedo-figures tradeoff-phong\n", "# material phong smooth: n=1000\n"}) {
    EXPECT_TRUE(contains(data, part)) << part;
  }
  for (const char* const part : {"time [s]", "set xlabel 'evaluations'", "relative error", "set logscale xy"}) {
    EXPECT_TRUE(contains(script, part)) << part;
  }
  // every column that the script draws is one of the data's
  const std::string heading = data.substr(data.find("\nmodel,") + 1);
  const std::string columns = "," + heading.substr(0, heading.find('\n')) + ",";
  for (const char* const column : {"seconds", "evaluations", "true_error", "reported_error"}) {
    EXPECT_TRUE(contains(script, "column('" + std::string(column) + "')")) << column;
    EXPECT_TRUE(contains(columns, "," + std::string(column) + ",")) << column;
  }
}

TEST_F(Figures, OfTheStabilityAtlasShowEveryCell) {
  if (!installed("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  const Outcome list = run("--list");
  for (const char* const name : {"\nstability ", "\nstability-anisotropic ", "\nstability-float "}) {
    EXPECT_TRUE(contains(list.out, name)) << list.out;
  }
  const Outcome outcome = run("stability-float --format png --output out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(names(), (Names{"stability-float.csv", "stability-float.gp", "stability-float.png"}));
  const std::string data = read(directory_ / "out/stability-float.csv");
  const std::string script = read(directory_ / "out/stability-float.gp");
  EXPECT_EQ(std::ranges::count(data.substr(data.find("\nsurface,") + 1), '\n'), 1 + 5 * 25 * 20);
  EXPECT_TRUE(contains(data, "# command: albedo-figures stability-float\n"));
  for (const char* const form : {"double", "float", "textbook_float"}) {
    EXPECT_TRUE(contains(data, ",gauss_lobe_" + std::string(form) + "_verdict,gauss_lobe_" + form + "_error")) << form;
  }
  for (const char* const part : {"degrees from grazing incidence", "Ashikhmin–Shirley", "NaN or infinity"}) {
    EXPECT_TRUE(contains(script, part)) << part;
  }
}

TEST_F(Figures, BringTheirPicturesAlong) {
  const Outcome outcome = run("ashikhmin-4 --data-only --output out", "PATH=/nowhere");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Names files{"ashikhmin-4-sphere.exr", "ashikhmin-4-sphere.png", "ashikhmin-4.csv", "ashikhmin-4.gp"};
  ASSERT_EQ(names(), files);
  const std::string exr = read(directory_ / "out/ashikhmin-4-sphere.exr");
  EXPECT_TRUE(exr.starts_with("\x76\x2f\x31\x01"));
  EXPECT_TRUE(contains(exr, "\"command\": \"albedo-figures ashikhmin-4\""));
  EXPECT_TRUE(contains(read(directory_ / "out/ashikhmin-4-sphere.png"), "\"command\": \"albedo-figures ashikhmin-4\""));
  ASSERT_EQ(run("ashikhmin-4 --data-only --output again", "OMP_NUM_THREADS=1").exit_code, 0);
  for (const std::string& file : files) {
    EXPECT_EQ(read(directory_ / "out" / file), read(directory_ / "again" / file)) << file;
  }
}

TEST_F(Figures, WithPicturesAreWrittenWholeOrNotAtAll) {
  fs::create_directory(directory_ / "out/ashikhmin-4-sphere.png");
  const Outcome outcome = run("ashikhmin-4 --data-only --output out");
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_TRUE(contains(outcome.err, "cannot write 'out/ashikhmin-4-sphere.png'")) << outcome.err;
  EXPECT_EQ(names(), Names{"ashikhmin-4-sphere.png"});
}

TEST_F(Figures, PlaceTheirPicturesInEveryFormat) {
  if (!installed("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  const Outcome outcome = run("ashikhmin-4 --format pdf --format png --format svg --output out");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_TRUE(contains(read(directory_ / "out/ashikhmin-4.svg"), "data:image/png;base64,"));
  EXPECT_TRUE(contains(read(directory_ / "out/ashikhmin-4.pdf"), "/Subtype /Image"));
  fs::remove(directory_ / "out/ashikhmin-4.svg");
  const std::string command =
      "cd '" + (directory_ / "out").string() + "' && gnuplot --default-settings -e \"format='svg'\" ashikhmin-4.gp";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(contains(read(directory_ / "out/ashikhmin-4.svg"), "data:image/png;base64,"));
}

TEST_F(Figures, CanBeDrawnAgainFromTheirFiles) {
  if (!installed("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
  ASSERT_EQ(run("neumann-1 --format png --output out").exit_code, 0);
  const std::string program_made = read(directory_ / "out/neumann-1.png");
  fs::remove(directory_ / "out/neumann-1.png");
  const std::string command =
      "cd '" + (directory_ / "out").string() + "' && gnuplot --default-settings -e \"format='png'\" neumann-1.gp";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read(directory_ / "out/neumann-1.png"), program_made);
}

}  // namespace
}  // namespace albedo::test::figures
