// SPDX-License-Identifier: Apache-2.0
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

int main() {
    return eglGetDisplay(EGL_DEFAULT_DISPLAY) == EGL_NO_DISPLAY;
}
