#include <sys/stat.h>

#include <cstring>
#include <iostream>
#include <random>
#include <thread>

#include "albedo/core/errors.hpp"
#include "analysis/files/atomic_file.hpp"
#include "analysis/output_directory.hpp"

namespace albedo::analysis {
namespace {

using AtomicFiles = OutputDirectory;

void write_file(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

mode_t permissions(const std::string& path) {
  struct stat info {};
  EXPECT_EQ(::stat(path.c_str(), &info), 0);
  return info.st_mode & 0777U;
}

TEST_F(AtomicFiles, AppearWhenTheyAreWhole) {
  AtomicFile file(path("a.txt"));
  file.stream() << "whole";
  EXPECT_FALSE(fs::exists(path("a.txt")));
  EXPECT_EQ(names().size(), 1U);
  file.finish();
  EXPECT_FALSE(fs::exists(path("a.txt")));
  file.commit();
  EXPECT_EQ(names(), Names{"a.txt"});
  EXPECT_EQ(read(path("a.txt")), "whole");
}

TEST_F(AtomicFiles, WithoutCommitLeaveEverythingAsItWas) {
  write_file(path("a.txt"), "old");
  {
    AtomicFile file(path("a.txt"));
    file.stream() << "new" << std::flush;
    AtomicFile other(path("b.txt"));
    other.stream() << "new";
    other.finish();
  }
  EXPECT_EQ(names(), Names{"a.txt"});
  EXPECT_EQ(read(path("a.txt")), "old");
}

TEST_F(AtomicFiles, TwoOfOneNameDontMix) {
  AtomicFile first(path("a.txt"));
  AtomicFile second(path("a.txt"));
  first.stream() << "first";
  second.stream() << "second";
  second.commit();
  EXPECT_EQ(read(path("a.txt")), "second");
  first.commit();
  EXPECT_EQ(read(path("a.txt")), "first");
  EXPECT_EQ(names(), Names{"a.txt"});
}

TEST_F(AtomicFiles, PermissionsFollowTheUmaskOrTheReplacedFile) {
  const mode_t before = ::umask(027);
  write_file(path("new.txt"), "x");
  ::umask(before);
  EXPECT_EQ(permissions(path("new.txt")), 0640U);
  ASSERT_EQ(::chmod(path("new.txt").c_str(), 0606), 0);
  write_file(path("new.txt"), "y");
  EXPECT_EQ(permissions(path("new.txt")), 0606U);
}

TEST_F(AtomicFiles, FollowSymbolicLinks) {
  fs::create_directory(path("data"));
  write_file(path("data/a.txt"), "old");
  fs::create_symlink("data/a.txt", path("link.txt"));
  write_file(path("link.txt"), "new");
  EXPECT_TRUE(fs::is_symlink(path("link.txt")));
  EXPECT_EQ(read(path("data/a.txt")), "new");
  fs::create_symlink(path("link.txt"), path("data/absolute.txt"));
  write_file(path("data/absolute.txt"), "newer");
  EXPECT_EQ(read(path("data/a.txt")), "newer");
  fs::create_symlink("data/b.txt", path("dangling.txt"));
  write_file(path("dangling.txt"), "b");
  EXPECT_EQ(read(path("data/b.txt")), "b");
  EXPECT_TRUE(fs::is_symlink(path("dangling.txt")));
  fs::create_symlink("circle.txt", path("circle.txt"));
  EXPECT_THROW(write_file(path("circle.txt"), "x"), WriteError);
}

TEST_F(AtomicFiles, LongNamesAndRelativePathsWork) {
  const std::string longest(255, 'n');
  write_file(path(longest), "x");
  EXPECT_EQ(names(), Names{longest});
  const fs::path before = fs::current_path();
  fs::current_path(directory_);
  write_file("relative.txt", "x");
  fs::current_path(before);
  EXPECT_EQ(read(path("relative.txt")), "x");
  EXPECT_TRUE(contains(message_of<WriteError>([&] { AtomicFile(path(longest + "n")); }), "File name too long"));
}

TEST_F(AtomicFiles, AnyMixOfWritesArrivesInOrder) {
  std::mt19937_64 generator(1);
  std::uniform_int_distribution<std::size_t> sizes(0, 3'000'000);
  std::string expected;
  {
    AtomicFile file(path("a.bin"));
    for (int i = 0; i < 60; ++i) {
      const std::string block(i % 3 == 0 ? sizes(generator) : sizes(generator) % 100, static_cast<char>('a' + i % 26));
      if (i % 7 == 0) file.stream() << std::flush;
      if (i % 2 == 0) {
        file.stream().write(block.data(), static_cast<std::streamsize>(block.size()));
      } else {
        for (const char c : block) file.stream().put(c);
      }
      expected += block;
      ASSERT_EQ(file.stream().tellp(), std::streampos(static_cast<std::streamoff>(expected.size())));
    }
    file.stream().seekp(5);
    file.stream() << "12345";
    expected.replace(5, 5, "12345");
    file.commit();
  }
  EXPECT_TRUE(read(path("a.bin")) == expected);
}

TEST_F(AtomicFiles, BadPlacesSayWhy) {
  write_file(path("file"), "x");
  const std::vector<std::pair<std::string, std::string>> cases{
      {path("none/a.txt"), "the directory '" + path("none") + "' does not exist"},
      {directory_.string(), "Is a directory"},
      {directory_.string() + "/", "Is a directory"},
      {path("file/a.txt"), "Not a directory"},
      {"", "No such file or directory"},
      {"/proc/albedo.txt", "No such file or directory"}};
  for (const auto& [target, reason] : cases) {
    const std::string expected = cannot_write(target, reason).what();
    EXPECT_TRUE(expected.starts_with("cannot write '" + target)) << expected;
    EXPECT_EQ(message_of<WriteError>([&t = target] { AtomicFile file(t); }), expected);
    EXPECT_EQ(message_of<WriteError>([&t = target] { AtomicFile::check(t); }), expected);
  }
  EXPECT_EQ(names(), Names{"file"});
}

TEST_F(AtomicFiles, CheckLeavesNothing) {
  AtomicFile::check(path("a.txt"));
  EXPECT_EQ(names(), Names{});
  write_file(path("a.txt"), "x");
  AtomicFile::check(path("a.txt"));
  EXPECT_EQ(names(), Names{"a.txt"});
  EXPECT_EQ(read(path("a.txt")), "x");
}

TEST_F(AtomicFiles, AFullDeviceIsAnError) {
  const std::string expected = "cannot write '/dev/full': No space left on device";
  AtomicFile::check("/dev/full");
  EXPECT_EQ(message_of<WriteError>([] { write_file("/dev/full", "x"); }), expected);
  EXPECT_EQ(message_of<WriteError>([] { write_file("/dev/full", std::string(5'000'000, 'x')); }), expected);
  EXPECT_EQ(message_of<WriteError>([] {
              AtomicFile file("/dev/full");
              for (;;) file.stream() << "one line after the other\n";
            }),
            expected);
}

TEST_F(AtomicFiles, ASwallowedFailureIsStillOneAtTheCommit) {
  AtomicFile file("/dev/full");
  const std::string block(5'000'000, 'x');
  EXPECT_THROW(file.stream().write(block.data(), 5'000'000), WriteError);
  EXPECT_EQ(message_of<WriteError>([&] { file.commit(); }), "cannot write '/dev/full': No space left on device");
}

TEST_F(AtomicFiles, WithNoRoomLeaveNothing) {
  const auto write_much = [&] {
    limit_file_size();
    exit_with("File too large", [&] { write_file(path("a.txt"), std::string(200'000, 'x')); });
  };
  EXPECT_EXIT(write_much(), testing::ExitedWithCode(4), "");
  EXPECT_EQ(names(), Names{});
}

TEST_F(AtomicFiles, WithoutPermissionSaySo) {
  write_file(path("read_only.txt"), "x");
  ASSERT_EQ(::chmod(path("read_only.txt").c_str(), 0444), 0);
  ASSERT_EQ(::chmod(directory_.c_str(), 0555), 0);
  const auto as_nobody = [&](const std::string& name) {
    if (::geteuid() == 0 && (::setgid(65534) != 0 || ::setuid(65534) != 0)) std::_Exit(6);
    exit_with("Permission denied", [&] { write_file(path(name), "y"); });
  };
  EXPECT_EXIT(as_nobody("new.txt"), testing::ExitedWithCode(4), "");
  ASSERT_EQ(::chmod(directory_.c_str(), 0777), 0);
  EXPECT_EXIT(as_nobody("new.txt"), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(as_nobody("read_only.txt"), testing::ExitedWithCode(4), "");
  EXPECT_EQ(read(path("read_only.txt")), "x");
}

TEST_F(AtomicFiles, PipesAreWrittenDirectly) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  AtomicFile::check(path("pipe"));
  std::string received;
  std::thread reader([&] { received = read(path("pipe")); });
  write_file(path("pipe"), "through the pipe");
  reader.join();
  EXPECT_EQ(received, "through the pipe");
  EXPECT_EQ(names(), Names{"pipe"});
}

TEST_F(AtomicFiles, DashIsStandardOutput) {
  testing::internal::CaptureStdout();
  std::cout << "before ";
  write_file("-", "x");
  write_file("/dev/stdout", "y");
  std::cout << " after";
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "before xy after");
}

}  // namespace
}  // namespace albedo::analysis
