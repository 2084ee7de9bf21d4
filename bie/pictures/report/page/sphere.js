// Surfaces from spherical-harmonic coefficients.

/**
 * Values on a lattice of the unit sphere, poles and both ends of the azimuth included, from coefficients of the real
 * orthonormal harmonics of vehd (degree n and order m at n² + n + m; sine for m < 0, no Condon-Shortley sign).
 */
class SphereLattice {
  constructor(degree) {
    this.degree = degree;
    // Equator and quarter turns are lattice points; the points can be counted in 16 bits.
    this.rows = Math.min(159, Math.max(65, 2 * degree + 1));
    this.columns = 2 * (this.rows + 1);
    this.legendre = [];
    for (let j = 0; j < this.rows; ++j) {
      this.legendre.push(SphereLattice.legendreTable(degree, Math.PI * j / (this.rows - 1)));
    }
    this.cosine = new Float32Array(degree * (this.columns + 1));
    this.sine = new Float32Array(degree * (this.columns + 1));
    for (let m = 1; m <= degree; ++m) {
      for (let k = 0; k <= this.columns; ++k) {
        const angle = 2 * Math.PI * ((m * k) % this.columns) / this.columns;
        this.cosine[(m - 1) * (this.columns + 1) + k] = Math.cos(angle);
        this.sine[(m - 1) * (this.columns + 1) + k] = Math.sin(angle);
      }
    }
  }

  /** Normalised Legendre functions with the √2 of m > 0, at n (n + 1) / 2 + m. */
  static legendreTable(degree, theta) {
    const table = new Float64Array((degree + 1) * (degree + 2) / 2);
    const x = Math.cos(theta), s = Math.sin(theta);
    const at = (n, m) => n * (n + 1) / 2 + m;
    let diagonal = Math.sqrt(1 / (4 * Math.PI));
    for (let m = 0; m <= degree; ++m) {
      if (m > 0) diagonal *= s * Math.sqrt((2 * m + 1) / (2 * m)) * (m === 1 ? Math.SQRT2 : 1);
      table[at(m, m)] = diagonal;
      for (let n = m + 1; n <= degree; ++n) {
        const a = Math.sqrt((4 * n * n - 1) / (n * n - m * m));
        const b = Math.sqrt(((n - 1) ** 2 - m * m) / (4 * (n - 1) ** 2 - 1));
        table[at(n, m)] = a * (x * table[at(n - 1, m)] - (n > m + 1 ? b * table[at(n - 2, m)] : 0));
      }
    }
    return table;
  }

  get points() {
    return this.rows * (this.columns + 1);
  }

  /** Writes values of one component to out[offset + stride i]. */
  synthesize(coefficients, out, offset = 0, stride = 1) {
    const degree = Math.round(Math.sqrt(coefficients.length)) - 1;
    const width = this.columns + 1;
    const row = new Float64Array(width);
    for (let j = 0; j < this.rows; ++j) {
      const table = this.legendre[j];
      row.fill(0);
      for (let m = 0; m <= degree; ++m) {
        let even = 0, odd = 0;
        for (let n = m; n <= degree; ++n) {
          const p = table[n * (n + 1) / 2 + m];
          even += p * coefficients[n * n + n + m];
          odd += p * coefficients[n * n + n - m];
        }
        if (m === 0) {
          row.fill(even);
        } else if (even !== 0 || odd !== 0) {
          const start = (m - 1) * width;
          for (let k = 0; k < width; ++k) row[k] += even * this.cosine[start + k] + odd * this.sine[start + k];
        }
      }
      for (let k = 0; k < width; ++k) out[offset + stride * (j * width + k)] = row[k];
    }
  }

  /** Outward unit normals of the surface through these points. */
  normals(x) {
    const width = this.columns + 1, half = this.rows - 1;
    const normals = new Float32Array(x.length);
    const point = (j, k) => 3 * (j * width + ((k % this.columns) + this.columns) % this.columns);
    const ringMean = (j) => {
      const mean = [0, 0, 0];
      for (let k = 0; k < this.columns; ++k) for (let c = 0; c < 3; ++c) mean[c] += normals[point(j, k) + c];
      return normalised(mean);
    };
    for (let j = 1; j < half; ++j) {
      for (let k = 0; k <= this.columns; ++k) {
        const up = point(j - 1, k), down = point(j + 1, k), left = point(j, k - 1), right = point(j, k + 1);
        const a = [0, 1, 2].map((c) => x[down + c] - x[up + c]);
        const b = [0, 1, 2].map((c) => x[right + c] - x[left + c]);
        normals.set(normalised(cross(a, b)), 3 * (j * width + k));
      }
    }
    for (const [pole, ring] of [[0, 1], [half, half - 1]]) {
      const normal = ringMean(ring);
      for (let k = 0; k <= this.columns; ++k) normals.set(normal, 3 * (pole * width + k));
    }
    return normals;
  }

  triangles() {
    const width = this.columns + 1;
    const triangles = new Uint16Array(6 * (this.rows - 1) * this.columns);
    let i = 0;
    for (let j = 0; j + 1 < this.rows; ++j) {
      for (let k = 0; k < this.columns; ++k) {
        const a = j * width + k, b = a + width;
        triangles.set([a, b, a + 1, a + 1, b, b + 1], i);
        i += 6;
      }
    }
    return triangles;
  }
}

function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function normalised(a) {
  const length = Math.hypot(a[0], a[1], a[2]) || 1;
  return a.map((component) => component / length);
}
