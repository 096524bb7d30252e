// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/madeOnce.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <thread>
#include <vector>

namespace patina {
namespace {

struct Key {
    int number;
    Key(int of) : number(of) {}
    bool isOf(int other) const { return number == other; }
};

using Numbers = MadeOnce<int, Key, int>;

Numbers::Pointer number(Numbers& numbers, int n) {
    return numbers.get(nullptr, n, [&] { return std::make_shared<const int>(n); });
}

void wait(int milliseconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

TEST(MadeOnce, IsTheSameWhileSomebodyHoldsIt) {
    Numbers numbers;
    const auto three = number(numbers, 3);
    EXPECT_EQ(number(numbers, 3), three);
    EXPECT_EQ(numbers.count(), 1u);
    number(numbers, 4);
    number(numbers, 4);
    EXPECT_EQ(numbers.count(), 3u) << "nobody held the first of the fours";
}

TEST(MadeOnce, WhoWaitsForWhatRunsOutOfMemoryIsToldAndTheNextTriesAgain) {
    Numbers numbers;
    std::atomic<bool> asked{false};
    std::atomic<int> failed{0};
    const auto ask = [&] {
        try {
            numbers.get(nullptr, 7, [&]() -> Numbers::Pointer {
                asked = true;
                wait(200); // until the other threads wait for this one
                throw std::bad_alloc();
            });
        } catch (const std::bad_alloc&) {
            ++failed;
        }
    };
    std::thread first(ask);
    while (!asked)
        wait(1);
    std::thread second(ask), third(ask);
    for (std::thread* thread : {&first, &second, &third})
        thread->join();
    EXPECT_EQ(failed, 3);
    const auto seven = number(numbers, 7);
    EXPECT_EQ(*seven, 7);
    EXPECT_EQ(number(numbers, 7), seven);
}

/// All of a loop want the same. Who makes it loops itself, and while it waits for the end of that
/// it must not take up another turn of the outer loop, which would wait for it.
TEST(MadeOnce, WhoMakesItTakesUpNothingThatWaitsForIt) {
    static thread_local bool makes = false;
    Numbers numbers;
    std::atomic<int> meetsItself{0};
    Arena(4).execute([&] {
        parallelFor(0, 64, [&](int) {
            if (makes) {
                ++meetsItself;
                return;
            }
            numbers.get(nullptr, 1, [&] {
                makes = true;
                parallelFor(0, 8, [](int) { wait(10); });
                makes = false;
                return std::make_shared<const int>(1);
            });
        });
    });
    EXPECT_EQ(meetsItself, 0);
}

TEST(Reference, KnowsAnObjectWhileItLives) {
    auto object = std::make_shared<const int>(5);
    const Reference<const int> reference(object);
    EXPECT_TRUE(reference.is(object));
    EXPECT_FALSE(reference.is(std::make_shared<const int>(5)));
    EXPECT_FALSE(reference.is(nullptr));
    EXPECT_TRUE(Reference<const int>(nullptr).is(nullptr));
    object = nullptr;
    EXPECT_FALSE(reference.is(nullptr)) << "an object that is gone is not none";
}

} // namespace
} // namespace patina
