#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "host/scene/reflectance.h"

namespace duolux::reference {

using Vec2 = glm::dvec2;  ///< (invisible, visible)
using Vec3 = glm::dvec3;

/// [[m00, m01], [m10, m11]], acting on columns (invisible, visible) from the left.
struct Matrix2 {
    double m00 = 0.0, m01 = 0.0, m10 = 0.0, m11 = 0.0;

    static Matrix2 identity() { return {1.0, 0.0, 0.0, 1.0}; }
    bool isZero() const { return m00 == 0.0 && m01 == 0.0 && m10 == 0.0 && m11 == 0.0; }
};

inline Matrix2 operator*(const Matrix2& a, const Matrix2& b) {
    return {a.m00 * b.m00 + a.m01 * b.m10, a.m00 * b.m01 + a.m01 * b.m11,  //
            a.m10 * b.m00 + a.m11 * b.m10, a.m10 * b.m01 + a.m11 * b.m11};
}

inline Matrix2 operator*(double s, const Matrix2& a) {
    return {s * a.m00, s * a.m01, s * a.m10, s * a.m11};
}

inline Matrix2 operator+(const Matrix2& a, const Matrix2& b) {
    return {a.m00 + b.m00, a.m01 + b.m01, a.m10 + b.m10, a.m11 + b.m11};
}

inline Matrix2 operator-(const Matrix2& a, const Matrix2& b) {
    return a + -1.0 * b;
}

inline Vec2 operator*(const Matrix2& a, Vec2 v) {
    return {a.m00 * v.x + a.m01 * v.y, a.m10 * v.x + a.m11 * v.y};
}

/// A matrix for each colour channel: the 6x6 block-diagonal matrix of the paper's eq. 17.
struct ChannelMatrix {
    Matrix2 channels[3];

    Matrix2& operator[](std::size_t c) { return channels[c]; }
    const Matrix2& operator[](std::size_t c) const { return channels[c]; }
};

/// Vector-valued light in each colour channel.
struct ChannelLight {
    Vec2 channels[3];

    Vec2& operator[](std::size_t c) { return channels[c]; }
    const Vec2& operator[](std::size_t c) const { return channels[c]; }
};

inline ChannelMatrix operator*(const ChannelMatrix& a, const ChannelMatrix& b) {
    return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}

inline ChannelMatrix operator*(double s, const ChannelMatrix& a) {
    return {s * a[0], s * a[1], s * a[2]};
}

inline ChannelMatrix operator+(const ChannelMatrix& a, const ChannelMatrix& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

inline ChannelLight operator*(const ChannelMatrix& a, const ChannelLight& v) {
    return {a[0] * v[0], a[1] * v[1], a[2] * v[2]};
}

inline ChannelLight operator*(double s, const ChannelLight& v) {
    return {s * v[0], s * v[1], s * v[2]};
}

inline ChannelLight operator+(const ChannelLight& a, const ChannelLight& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

inline bool isZero(const ChannelMatrix& a) {
    return a[0].isZero() && a[1].isZero() && a[2].isZero();
}

inline ChannelMatrix identityPerChannel() {
    return {Matrix2::identity(), Matrix2::identity(), Matrix2::identity()};
}

inline ChannelMatrix channelsOf(const ReflectanceMatrix& m) {
    ChannelMatrix result;
    for (int c = 0; c < 3; ++c) {
        result[static_cast<std::size_t>(c)] = {static_cast<double>(m.m00[c]), static_cast<double>(m.m01[c]),
                                               static_cast<double>(m.m10[c]), static_cast<double>(m.m11[c])};
    }
    return result;
}

inline ChannelLight channelsOf(glm::vec3 invisible, glm::vec3 visible) {
    const Vec3 i(invisible), v(visible);
    return {Vec2(i.r, v.r), Vec2(i.g, v.g), Vec2(i.b, v.b)};
}

/// diag(s) applied channel by channel.
inline ChannelMatrix scaled(glm::vec3 s, const ChannelMatrix& a) {
    const Vec3 d(s);
    return {d.r * a[0], d.g * a[1], d.b * a[2]};
}

}  // namespace duolux::reference
