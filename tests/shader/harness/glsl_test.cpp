#include "tests/shader/harness/glsl_test.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <future>
#include <map>
#include <semaphore>
#include <set>
#include <thread>

#include "host/base/hash.h"
#include "host/vk/commands.h"
#include "tests/shader/harness/compiler.h"
#include "tests/shader/harness/kernel_run.h"
#include "tests/shader/harness/source_text.h"
#include "tests/support/device.h"

namespace duolux::test {

namespace {

/// The kernels of test files; each is compiled once.
class Kernels {
  public:
    std::vector<std::uint32_t> of(const GlslFile& file) { return entry(file).get(); }

    void compileInBackground(const GlslFile& file) { entry(file); }

  private:
    using Spirv = std::vector<std::uint32_t>;
    std::shared_future<Spirv> entry(const GlslFile& file) {
        std::shared_future<Spirv>& future = futures_[file.name];
        if (!future.valid()) {
            // Uses a copy of sourceRoots(), and at most one compiler per core.
            future =
                std::async(std::launch::async, [glsl = kernelOf(file), roots = sourceRoots()] {
                    static std::counting_semaphore<> cores(std::max(1u, std::thread::hardware_concurrency()));
                    cores.acquire();
                    try {
                        Spirv spirv = compileKernel(glsl, roots);
                        cores.release();
                        return spirv;
                    } catch (...) {
                        cores.release();
                        throw;
                    }
                }).share();
        }
        return future;
    }
    std::map<std::string, std::shared_future<Spirv>> futures_;
};

Kernels& kernels() {
    static Kernels instance;
    return instance;
}

/// The random inputs of a test depend on its name alone.
std::uint32_t seedOf(std::string_view test) {
    Hasher hasher;
    hasher.add(test);
    return static_cast<std::uint32_t>(hasher.digest());
}

template <typename T>
std::vector<T> contents(const Buffer& buffer, std::size_t count) {
    buffer.invalidate();
    std::vector<T> out(count);
    std::memcpy(out.data(), buffer.mapped(), count * sizeof(T));
    return out;
}

void dispatchAll(const Kernel& kernel, const GlslFile::Test& test, std::uint32_t pass,
                 std::uint32_t noted = 0) {
    for (std::uint32_t first = 0; first < test.count; first += kInvocationsPerDispatch) {
        const std::uint32_t count = std::min(kInvocationsPerDispatch, test.count - first);
        const shared::TestDispatch push{first, test.count, seedOf(test.name) ^ randomSeed(), pass, noted};
        runOnce(device(), test.name, [&](const Commands& commands) {
            kernel.dispatch(commands, push, (count + shared::kTestWorkgroup - 1) / shared::kTestWorkgroup);
        });
    }
}

class GlslTest : public testing::Test {
  public:
    GlslTest(GlslFile file, std::size_t index) : file_(std::move(file)), index_(index) {}

  private:
    void TestBody() override {
        try {
            for (const GlslFailure& f : runGlslTest(file_, index_)) {
                const std::size_t line = f.line > 0 ? f.line : file_.tests[index_].line;
                ADD_FAILURE_AT(file_.name.c_str(), static_cast<int>(line)) << f.message;
            }
        } catch (const CompileError& e) {
            const CompileError::Place place = e.place();
            if (place.line > 0) {
                ADD_FAILURE_AT(place.file.c_str(), static_cast<int>(place.line)) << e.what();
            } else {
                ADD_FAILURE_AT(file_.name.c_str(), static_cast<int>(file_.tests[index_].line)) << e.what();
            }
        }
    }

    GlslFile file_;
    std::size_t index_;
};

/// Before the first test, starts compiling the kernels of all files with selected tests in parallel.
class CompileAhead : public testing::Environment {
  public:
    void add(const std::string& suite, const GlslFile& file) { files_[suite] = file; }
    void SetUp() override {
        const testing::UnitTest& tests = *testing::UnitTest::GetInstance();
        for (int s = 0; s < tests.total_test_suite_count(); ++s) {
            const testing::TestSuite& suite = *tests.GetTestSuite(s);
            const auto file = files_.find(suite.name());
            if (suite.should_run() && file != files_.end()) kernels().compileInBackground(file->second);
        }
    }

  private:
    std::map<std::string, GlslFile> files_;
};

class BrokenFile : public testing::Test {
  public:
    explicit BrokenFile(std::string why) : why_(std::move(why)) {}

  private:
    void TestBody() override {
        // FILE:LINE: what.
        const std::size_t colon = why_.find(':');
        const int line = colon != std::string::npos ? std::atoi(why_.c_str() + colon + 1) : 1;
        ADD_FAILURE_AT(why_.substr(0, colon).c_str(), line) << why_;
    }
    std::string why_;
};

}  // namespace

std::uint32_t& randomSeed() {
    static std::uint32_t seed = 0;
    return seed;
}

std::vector<GlslFailure> runGlslTest(const GlslFile& file, std::size_t index) {
    const GlslFile::Test& test = file.tests[index];
    const std::vector<std::uint32_t> spirv = kernels().of(file);
    const std::size_t lines = file.lines + 1;
    const std::size_t words = (test.count + 31) / 32;
    const Buffer expectations =
        Buffer::readback(device(), lines * sizeof(shared::Expectation), "expectations");
    const Buffer invocations =
        Buffer::readback(device(), words * sizeof(std::uint32_t), "failed invocations");
    runOnce(device(), "clearing expectations", [&](const Commands& commands) {
        commands.fill(expectations, 0);
        commands.fill(invocations, 0);
    });
    const Kernel kernel =
        harnessKernel(file.name, spirv,
                      std::vector<Binding>{{shared::kBindingExpectations, &expectations},
                                           {shared::kBindingInvocations, &invocations}},
                      std::vector<Specialization>{{shared::kSpecTest, static_cast<std::uint32_t>(index)}},
                      sizeof(shared::TestDispatch));
    dispatchAll(kernel, test, shared::kPassCount);
    std::size_t failed = 0;
    for (const std::uint32_t word : contents<std::uint32_t>(invocations, words))
        failed += static_cast<std::size_t>(std::popcount(word));
    if (failed > 0) {
        dispatchAll(kernel, test, shared::kPassFirst);
        dispatchAll(kernel, test, shared::kPassWorst);
    }
    const std::vector<shared::Expectation> read = contents<shared::Expectation>(expectations, lines);
    std::vector<GlslFailure> failures = readExpectations(file, test, read, failed);
    const auto first =
        std::find_if(read.begin(), read.end(), [](const shared::Expectation& e) { return e.failed > 0; });
    if (file.notes.empty() || first == read.end()) return failures;
    dispatchAll(kernel, test, shared::kPassNotes, ~first->first);
    const std::string notes = readNotes(file, contents<shared::Expectation>(expectations, lines));
    const auto failure = std::find_if(failures.begin(), failures.end(), [&](const GlslFailure& f) {
        return f.message.find(fmt::format("first: invocation {}\n", ~first->first)) != std::string::npos;
    });
    if (failure != failures.end() && !notes.empty()) {
        failure->message += fmt::format("  noted in invocation {}\n{}", ~first->first, notes);
    }
    return failures;
}

void registerGlslTests(const std::filesystem::path& folder) {
    std::set<std::string> names;
    if (!std::filesystem::is_directory(projectRoot() / folder)) {
        throw std::runtime_error(
            fmt::format("{}: no such folder of tests", (projectRoot() / folder).string()));
    }
    for (const auto& entry : std::filesystem::directory_iterator(projectRoot() / folder)) {
        if (entry.path().filename().string().ends_with("_test.glsl"))
            names.insert((folder / entry.path().filename()).string());
    }
    auto* ahead = new CompileAhead;  // GoogleTest owns it
    testing::AddGlobalTestEnvironment(ahead);
    for (const std::string& name : names) {
        std::string stem = std::filesystem::path(name).stem().string();
        stem.resize(stem.size() - std::string_view("_test").size());
        const std::string suite = pascalCase(stem) + "Glsl";
        try {
            const GlslFile file = parseGlslFile(name, readSource(name));
            ahead->add(suite, file);
            for (std::size_t i = 0; i < file.tests.size(); ++i) {
                testing::RegisterTest(suite.c_str(), file.tests[i].name.c_str(), nullptr, nullptr,
                                      name.c_str(), static_cast<int>(file.tests[i].line),
                                      [=]() -> testing::Test* { return new GlslTest(file, i); });
            }
        } catch (const std::runtime_error& e) {
            const std::string why = e.what();
            testing::RegisterTest(suite.c_str(), "CanBeRead", nullptr, nullptr, name.c_str(), 1,
                                  [=]() -> testing::Test* { return new BrokenFile(why); });
        }
    }
}

}  // namespace duolux::test
