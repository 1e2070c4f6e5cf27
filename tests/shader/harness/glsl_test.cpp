#include "tests/shader/harness/glsl_test.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <future>
#include <map>
#include <set>

#include "host/vk/commands.h"
#include "tests/shader/harness/compiler.h"
#include "tests/shader/harness/kernel_run.h"
#include "tests/shader/harness/source_text.h"
#include "tests/support/device.h"

namespace duolux::test {

namespace {

/// A dispatch of more might run longer than a driver's watchdog allows.
constexpr std::uint32_t kInvocationsPerDispatch = 1u << 20;

/// The kernels of files, each compiled once.
class Kernels {
  public:
    std::vector<std::uint32_t> of(const GlslFile& file) { return entry(file).get(); }

    void compileInBackground(const GlslFile& file) { entry(file); }

  private:
    using Spirv = std::vector<std::uint32_t>;
    std::shared_future<Spirv> entry(const GlslFile& file) {
        std::shared_future<Spirv>& future = futures_[file.name];
        if (!future.valid()) {
            future = std::async(std::launch::async, [file] { return compileKernel(kernelOf(file)); }).share();
        }
        return future;
    }
    std::map<std::string, std::shared_future<Spirv>> futures_;
};

Kernels& kernels() {
    static Kernels instance;
    return instance;
}

/// FNV-1a: the random inputs of a test depend on its name alone.
std::uint32_t hashOf(std::string_view text) {
    std::uint32_t hash = 2166136261u;
    for (const char c : text)
        hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
    return hash;
}

template <typename T>
std::vector<T> contents(const Buffer& buffer, std::size_t count) {
    buffer.invalidate();
    std::vector<T> out(count);
    std::memcpy(out.data(), buffer.mapped(), count * sizeof(T));
    return out;
}

void dispatchAll(const Kernel& kernel, const GlslFile::Test& test, std::uint32_t pass) {
    for (std::uint32_t first = 0; first < test.count; first += kInvocationsPerDispatch) {
        const std::uint32_t count = std::min(kInvocationsPerDispatch, test.count - first);
        const shared::TestDispatch push{first, test.count, hashOf(test.name), pass};
        runOnce(device(), test.name, [&](const vk::raii::CommandBuffer& commands) {
            kernel.dispatch(commands, push, (count + shared::kTestWorkgroup - 1) / shared::kTestWorkgroup);
        });
    }
}

class GlslTest : public testing::Test {
  public:
    GlslTest(GlslFile file, std::size_t index) : file_(std::move(file)), index_(index) {}

  private:
    void TestBody() override {
        std::vector<GlslFailure> failures;
        try {
            failures = runGlslTest(file_, index_);
        } catch (const CompileError& e) {
            failures.push_back({e.lineIn(file_.name), fmt::format("does not compile:\n{}", e.what())});
        }
        for (const GlslFailure& f : failures) {
            const std::size_t line = f.line > 0 ? f.line : file_.tests[index_].line;
            ADD_FAILURE_AT(file_.name.c_str(), static_cast<int>(line)) << f.message;
        }
    }

    GlslFile file_;
    std::size_t index_;
};

/// Before the first test, kernels of all files of which a test was chosen begin to be compiled side by side.
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
    void TestBody() override { FAIL() << why_; }
    std::string why_;
};

}  // namespace

std::vector<GlslFailure> runGlslTest(const GlslFile& file, std::size_t index) {
    const GlslFile::Test& test = file.tests[index];
    const std::vector<std::uint32_t> spirv = kernels().of(file);
    const std::size_t lines = file.lines + 1;
    const std::size_t words = (test.count + 31) / 32;
    const Buffer expectations = Buffer::readback(device(), lines * sizeof(shared::Expectation),
                                                 "expectations", vk::BufferUsageFlagBits::eTransferDst);
    const Buffer invocations = Buffer::readback(device(), words * sizeof(std::uint32_t), "failed invocations",
                                                vk::BufferUsageFlagBits::eTransferDst);
    runOnce(device(), "clearing expectations", [&](const vk::raii::CommandBuffer& commands) {
        commands.fillBuffer(expectations.handle(), 0, VK_WHOLE_SIZE, 0);
        commands.fillBuffer(invocations.handle(), 0, VK_WHOLE_SIZE, 0);
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
    return readExpectations(file, test, contents<shared::Expectation>(expectations, lines), failed);
}

void registerGlslTests(const std::filesystem::path& folder) {
    std::set<std::string> names;
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
