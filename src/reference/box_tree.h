/// Embree as a tree of boxes: it finds the candidates along a ray, the caller intersects them in
/// double precision.
#pragma once

#include "reference/surface.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace tyndall::reference {

class BoxTree {
  public:
    /// The items are numbered as their boxes are. Boxes are finite.
    /// @throws Error failed if Embree cannot build the tree.
    explicit BoxTree(const std::vector<Bounds>& boxes);
    ~BoxTree();
    BoxTree(BoxTree&&) noexcept;
    BoxTree& operator=(BoxTree&&) noexcept;

    class Visitor {
      public:
        /// Intersects one item. Returns t_max, or the t of a hit before t_max.
        virtual double visit(std::uint32_t item, double t_max) = 0;

      protected:
        ~Visitor() = default;
    };

    /// Visits every item that the ray may hit with 0 < t < t_max, in any order, where t_max shrinks
    /// to what the visitor returns. Embree sees the ray in single precision: the boxes are padded
    /// by more than that can move it, so that nothing is missed.
    void traverse(const Ray& ray, double t_max, Visitor& visitor) const;

    const Bounds& bounds() const { return bounds_; } ///< Of all boxes.

  private:
    struct Embree;
    Bounds bounds_;
    std::unique_ptr<Embree> embree_; ///< None without boxes.
};

} // namespace tyndall::reference
