"""Present fits and diagnoses: sentences, tables, JSON, model files, figures, and an HTML page (`html/`).

In: a `Fit` or a `Diagnosis`. Out: text and files. Nothing here computes a result.
"""
