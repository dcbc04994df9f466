// SPDX-License-Identifier: Apache-2.0
#include "plugins/overrun.hpp"

#include <memory>
#include <new>
#include <vector>

#include <gtest/gtest.h>

#include "plugins/guarded_model.hpp"

namespace tunica::plugins {
namespace {

/// Writes what is wanted, and does something wrong beside.
class Writer final : public Model {
 public:
  enum class Wrong { nothing, behind, before, behind_seven_points, no_memory_once, no_memory };
  explicit Writer(Wrong wrong) : wrong_(wrong) { description_.type = "writer"; }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints&, const MaterialResponse&) const override { return Status::failed("no"); }
  Status evaluate_axes(const AxisPoints& points, const AxisResponse& response) const override {
    ++calls;
    if (wrong_ == Wrong::no_memory || (wrong_ == Wrong::no_memory_once && calls == 1)) throw std::bad_alloc();
    double value = 0;
    for (const auto& output : {response.energy, response.gradient, response.hessian})
      for (double& number : output) number = ++value;
    if (wrong_ == Wrong::behind) response.gradient.data()[response.gradient.size()] = 1;
    if (wrong_ == Wrong::before) response.gradient.data()[-1] = 1;
    if (wrong_ == Wrong::behind_seven_points && points.count == 7) response.gradient.data()[21] = 1;
    return {};
  }
  mutable int calls = 0;

 private:
  ModelDescription description_;
  Wrong wrong_;
};

/// A guarded writer, and a caller that leaves room around what it wants.
struct Bench {
  explicit Bench(Writer::Wrong wrong) {
    auto made = std::make_unique<Writer>(wrong);
    writer = made.get();
    model = std::make_unique<GuardedModel>(std::move(made), "writer 1");
  }
  Status evaluate(std::size_t points) {
    memory.assign(20 + 10 * points, 0.0);
    const std::span<double> room(memory);
    gradient = room.subspan(8, 3 * points);
    const std::vector<double> c(3 * points, 1.0);
    return model->evaluate_axes({points, c, {}}, {{}, gradient, {}, {}});
  }
  Writer* writer;
  std::unique_ptr<GuardedModel> model;
  std::vector<double> memory;
  std::span<double> gradient;
};

TEST(Overrun, BeforeOrBehindAnOutputFailsAndStays) {
  for (const auto wrong : {Writer::Wrong::behind, Writer::Wrong::before}) {
    Bench bench(wrong);
    for (int call = 0; call < 3; ++call)
      EXPECT_EQ(bench.evaluate(4).reason(),
                "plugin 'writer 1' wrote beyond the ends of its gradient and is not evaluated again; expected nothing "
                "outside of the span. `tunica plugin check` shows where");
    EXPECT_EQ(bench.writer->calls, 1);
    EXPECT_EQ(bench.memory[7], 0) << "the caller's memory was written to";
    EXPECT_EQ(bench.memory[8 + 12], 0) << "the caller's memory was written to";
  }
}

TEST(Overrun, OfOneNumberOfPointsIsFoundAfterOthersWereInOrder) {
  Bench bench(Writer::Wrong::behind_seven_points);
  EXPECT_TRUE(bench.evaluate(8).ok());
  EXPECT_TRUE(bench.evaluate(8).ok());
  EXPECT_FALSE(bench.evaluate(7).ok());
  EXPECT_FALSE(bench.evaluate(8).ok()) << "it goes on after it was found";
}

TEST(Overrun, LeavesAnHonestModelItsNumbers) {
  Bench bench(Writer::Wrong::nothing);
  for (int call = 0; call < 3; ++call) {  // the first one between fences
    ASSERT_TRUE(bench.evaluate(5).ok());
    for (std::size_t i = 0; i < 15; ++i) EXPECT_EQ(bench.gradient[i], static_cast<double>(i + 1));
  }
}

TEST(Overrun, FencesNestAndKeepWhatWasThere) {
  std::vector<double> outer{1, 2, 3}, inner{4, 5};
  NamedOutput first[] = {{"energy", outer}, {"stress", {}}}, second[] = {{"energy", inner}};
  FencedOutputs around(first);
  FencedOutputs inside(second);
  EXPECT_EQ(first[0].values[2], 3);
  second[0].values[0] = 7;
  first[0].values[0] = 6;
  EXPECT_EQ(inside.release(second), nullptr);
  EXPECT_EQ(around.release(first), nullptr);
  EXPECT_EQ(inner, (std::vector<double>{7, 5}));
  EXPECT_EQ(outer, (std::vector<double>{6, 2, 3}));
  EXPECT_EQ(first[0].values.data(), outer.data());
}

TEST(GuardedModel, AsksOnceMoreWhereMemoryLackedForAMoment) {
  Bench moment(Writer::Wrong::no_memory_once), always(Writer::Wrong::no_memory);
  EXPECT_TRUE(moment.evaluate(2).ok());
  EXPECT_EQ(moment.gradient[5], 6);
  EXPECT_EQ(always.evaluate(2).reason(), "plugin 'writer 1' threw: std::bad_alloc");
}

}  // namespace
}  // namespace tunica::plugins
