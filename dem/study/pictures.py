# SPDX-License-Identifier: MIT
"""All pictures of the study's page, chapter by chapter."""

import os
import shutil

import charts
import figures_anisotropy
import figures_growth
import figures_local
import figures_shear
import figures_states
import figures_strength
import rendering
import state_tables
from figures import Maker
from results import Results


def draw(out, tool, jobs, quick):
    """Makes OUT/pictures afresh and returns the page's chapters.

    @param jobs   pictures of bodies that are drawn at once
    @param quick  two states in place of four
    """
    folder = os.path.join(out, "pictures")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    results = Results(out)
    states = state_tables.States(results, tool, folder, quick)
    maker, pictures = Maker(results, states), figures_states.Pictures(states)
    chapters = [*figures_growth.chapters(maker), *figures_shear.chapters(maker),
                figures_states.chapter(pictures), *figures_anisotropy.chapters(maker),
                *figures_strength.chapters(maker), *figures_local.chapters(maker)]
    charts.draw(maker.charts, folder)
    rendering.render(folder, pictures.scenes, jobs)
    return chapters
