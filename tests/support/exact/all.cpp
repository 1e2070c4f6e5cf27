#include <iterator>

#include "tests/support/exact_case.h"

namespace duolux::test {

std::vector<ExactCase> exactCases() {
    std::vector<ExactCase> all;
    for (auto* cases : {enclosureCases, crossingCases, furnaceCases, lambertCases, blockerCases}) {
        std::vector<ExactCase> some = cases();
        all.insert(all.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
    }
    return all;
}

}  // namespace duolux::test
