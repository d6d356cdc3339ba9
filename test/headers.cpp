// SPDX-License-Identifier: BSD-3-Clause
// Nothing: the tests' precompiled headers must belong to a target, and a target has a source.
