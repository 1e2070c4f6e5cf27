// Connections of light paths to the camera, and the sums of the film that they add to.

// What surfaces may scatter or transmit of a light path's flux, in its largest channel. Without a second column, the
// visible component contributes only at the camera.
float carried(Radiance2 l) { return maxComponent(l.invisible + (kSecondColumn ? l.visible : vec3(0.0))); }

// Radiance weighted by PathParams.rowWeight: the maximum over the channels.
float rowWeighted(Radiance2 l) {
    return maxComponent(params.rowWeight.x * l.invisible + params.rowWeight.y * l.visible);
}

// Probability that a connection survives which keeps `left` of its contribution `whole`.
float connectionSurvival(float left, float whole) { return min(left / whole, 1.0); }

float channelMean(vec3 v) { return (v.x + v.y + v.z) * (1.0 / 3.0); }

// Adds to one sum of the film. Returns whether the sum had already exceeded 63 bits.
bool filmAtomicAdd(uint band, uint index, uvec2 quanta) {
#ifdef DUOLUX_INT64_ATOMICS
    return unpackUint2x32(atomicAdd(film[band].sums[index], packUint2x32(quanta))).y >= 0x80000000u;
#else
    uint before = atomicAdd(film[band].sums[index].x, quanta.x);
    return atomicAdd(film[band].sums[index].y, quanta.y + (before + quanta.x < before ? 1u : 0u)) >= 0x80000000u;
#endif
}

// `stream`: of the light path.
void splat(inout LaneSums sums, Radiance2 arriving, Connection connection, uvec2 stream) {
    uint pixel = connection.pixel;
    vec3 total = arriving.invisible + arriving.visible;
    float sum = total.x + total.y + total.z;
    // Written so that NaN is dropped, too.
    bool fine = sum < kLargestSample;
    sums.nonFinite += fine ? 0u : 1u;
    if (!fine) return;
    sums.clamped += sum * dispatch.inverseQuantum >= kFilmLargest ? 1u : 0u;
    uint index = (kFilmBands > 1u ? pixel % kBandPixels : pixel) * kFilmSums;
    uvec2[kFilmSums] quanta;
    FilmRounding u = filmRounding(stream.x, stream.y, connection.dimension, params.seed);
    for (int c = 0; c < 3; c++) {
        quanta[c] = filmQuantise(arriving.invisible[c], dispatch.inverseQuantum, u.invisible[c]);
        quanta[c + 3] = filmQuantise(arriving.visible[c], dispatch.inverseQuantum, u.visible[c]);
    }
    for (uint band = 0u; band < kFilmBands; band++) {
        if (kFilmBands == 1u || pixel / kBandPixels == band) {
            uint beyond = 0u;
            for (uint i = 0u; i < kFilmSums; i++) beyond |= filmAtomicAdd(band, index + i, quanta[i]) ? 1u << i : 0u;
            // A sum of 2^63 or more is beyond the range. It must not reach 2^64 and wrap around to a valid value, so an
            // addition to a sum that was already beyond the range is undone. In any order of the additions, the final
            // sum is then beyond the range if and only if the exact sum is. The host sees it as a negative number.
            while (beyond != 0u) {
                uint i = uint(findLSB(beyond));
                beyond &= beyond - 1u;
                filmAtomicAdd(band, index + i, filmNegate(quanta[i]));
            }
        }
    }

    vec3 displayed = params.display.x * arriving.invisible + params.display.y * arriving.visible;
    float mean = channelMean(displayed);
    float inverseUnit = dispatch.inverseQuantum * (1.0 / kStatisticsQuanta);
    uint scatterings = connection.scatterings;
    if (scatterings == params.bounces) sums.lastBounce = filmAddSigned(sums.lastBounce, mean, inverseUnit);
    if (scatterings + 1u == params.bounces) sums.previousBounce = filmAddSigned(sums.previousBounce, mean, inverseUnit);
    sums.invisible = filmAddSigned(sums.invisible, channelMean(arriving.invisible), inverseUnit);
    sums.visible = filmAddSigned(sums.visible, channelMean(arriving.visible), inverseUnit);
}

vec3 directionToCamera(vec3 point) { return connectToCamera(params.camera, point).direction; }

// Sets up a ray to the camera.
void connect(inout Connection connection, LightPath path, Outgoing outgoing) {
    CameraConnection camera = connectToCamera(params.camera, outgoing.point.position);
    float cosine = dot(outgoing.point.geometricNormal, camera.direction);
    cosine = kTransmits ? abs(cosine) : max(cosine, 0.0);
    Radiance2 arriving = scaled(outgoing.intensity, vec3(cosine * camera.importance));
    // Connections that contribute mainly to the undisplayed component are traced less often.
    float brightness = maxComponent(max(arriving.invisible, arriving.visible));
    float worth = max(params.rowWeight.x, params.rowWeight.y) * brightness;
    float survival = connectionSurvival(rowWeighted(arriving), worth);
    // Connections at grazing angles, which are dim, are traced less often as well: this saves a sixth of the rays for 6
    // to 8 % more variance.
    survival *= outgoing.scatterings > 0u ? min(3.0 * cosine, 1.0) : 1.0;
    float roulette =
        drawChoice(path.stream, sampleDimension(outgoing.scatterings, path.crossings, kDimensionConnection));
    // Written so that NaN is traced, and counted when it arrives.
    connection.pending = camera.visible && !(brightness <= 0.0) && !(roulette >= survival);
    bool through = kTransmits && dot(outgoing.point.geometricNormal, camera.direction) < 0.0;
    connection.segment = leaveSurface(outgoing.point, camera.direction, through);
    connection.distance = camera.distance;
    connection.arriving = arriving;
    connection.roulette = roulette;
    connection.survival = survival;
    connection.pixel = camera.pixel;
    connection.scatterings = outgoing.scatterings;
    connection.dimension = sampleDimension(outgoing.scatterings, path.crossings, kDimensionRounding);
}

// The ray to the camera has met a surface, or nothing more.
void continueConnection(inout Connection connection, inout LaneSums sums, uvec2 stream, Traversal ray, bool found,
                        uint material) {
    if (kVisitsToCamera && found) {
        float before = rowWeighted(connection.arriving);
        float coverage = coverageAt(ray.triangle, material, ray.barycentric);
        Radiance2 through = crossed(connection.arriving, material, coverage, kCameraTransparency);
        // Russian roulette on the loss of displayed radiance; one random number serves the whole ray.
        connection.survival *= connectionSurvival(rowWeighted(through), before);
        connection.arriving = through;
        crossSurface(connection.segment, ray);
        connection.pending = connection.roulette < connection.survival;
        return;
    }
    Radiance2 arriving = connection.arriving;
    if (found) {
        // The invisible component passes unchanged through surfaces, which block the visible one.
        bool passes = kCameraTransparency == kTransparencyIdentity;
        arriving = Radiance2(passes ? arriving.invisible : vec3(0.0), vec3(0.0));
    }
    arriving = scaled(arriving, vec3(1.0 / connection.survival));
    if (maxComponent(arriving.invisible + arriving.visible) != 0.0) splat(sums, arriving, connection, stream);
    connection.pending = false;
}
