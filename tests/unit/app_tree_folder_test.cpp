#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>

#include "host/app/tree_folder.h"

namespace duolux {
namespace {

class UserTreeFolder : public testing::Test {
  protected:
    UserTreeFolder() {
        for (const char* name : {"XDG_CACHE_HOME", "HOME", "DUOLUX_NO_CACHE"}) {
            const char* value = std::getenv(name);
            if (value != nullptr) before_[name] = value;
            ::unsetenv(name);
        }
    }
    ~UserTreeFolder() override {
        for (const char* name : {"XDG_CACHE_HOME", "HOME", "DUOLUX_NO_CACHE"}) {
            ::unsetenv(name);
            if (before_.contains(name)) ::setenv(name, before_[name].c_str(), 1);
        }
    }

  private:
    std::map<std::string, std::string> before_;
};

TEST_F(UserTreeFolder, IsBelowXdgCacheHomeOrHome) {
    EXPECT_EQ(userTreeFolder(), "");
    ::setenv("HOME", "/home/someone", 1);
    EXPECT_EQ(userTreeFolder(), "/home/someone/.cache/duolux");
    ::setenv("XDG_CACHE_HOME", "relative", 1);
    EXPECT_EQ(userTreeFolder(), "/home/someone/.cache/duolux");
    ::setenv("XDG_CACHE_HOME", "/caches", 1);
    EXPECT_EQ(userTreeFolder(), "/caches/duolux");
}

TEST_F(UserTreeFolder, CanBeTurnedOff) {
    ::setenv("XDG_CACHE_HOME", "/caches", 1);
    ::setenv("DUOLUX_NO_CACHE", "1", 1);
    EXPECT_EQ(userTreeFolder(), "");
}

}  // namespace
}  // namespace duolux
