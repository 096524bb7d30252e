// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/glTimer.h"

namespace patina {

GlTimer::~GlTimer() {
    if (!_queries.empty()) gl.DeleteQueries(GLsizei(_queries.size()), _queries.data());
}

GLuint GlTimer::next() {
    if (_shares.size() >= _queries.size()) {
        GLuint query = 0;
        gl.CreateQueries(GL_TIMESTAMP, 1, &query);
        _queries.push_back(query);
    }
    return _queries[_shares.size()];
}

void GlTimer::mark(Share share) {
    gl.QueryCounter(next(), GL_TIMESTAMP);
    _shares.push_back(share);
}

void GlTimer::collect() {
    if (_shares.empty()) return;
    gl.QueryCounter(next(), GL_TIMESTAMP);
    GLuint64 before = 0;
    for (size_t i = 0; i <= _shares.size(); ++i) {
        GLuint64 now = 0;
        gl.GetQueryObjectui64v(_queries[i], GL_QUERY_RESULT, &now);
        if (i > 0 && now > before) _seconds[_shares[i - 1]] += double(now - before) * 1e-9;
        before = now;
    }
    _shares.clear();
}

} // namespace patina
